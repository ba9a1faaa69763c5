#include "change.h"

namespace bough {

template <class T> void scale_wood(Plan<T>& plan, double stiffness, double damping) {
    for (Vector3<T>& K : plan.K) K *= T(stiffness);
    for (T& beta : plan.beta) beta *= T(damping);
    plan.stepper->scale_wood(plan, T(stiffness), T(damping));
}

template <class T> void change_step(Plan<T>& plan, State<T>& state, double dt) {
    state.time_since = time_of(plan, state);
    state.step_since = state.step;
    const T ratio = T(dt / plan.dt);
    plan.dt = dt;
    plan.stepper->step_changed(plan, state, ratio);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void scale_wood(Plan<T>&, double, double);                                                                \
    template void change_step(Plan<T>&, State<T>&, double);
BOUGH_INSTANTIATE(float)
BOUGH_INSTANTIATE(double)
#undef BOUGH_INSTANTIATE

} // namespace bough
