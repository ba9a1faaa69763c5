#include "change.h"

namespace bough {

template <class T> void scale_wood(Plan<T>& plan, State<T>& state, double stiffness, double damping) {
    for (Vector3<T>& K : plan.K) K *= T(stiffness);
    for (T& beta : plan.beta) beta *= T(damping);
    plan.stepper->change(plan, state, {.stiffness = T(stiffness), .damping = T(damping), .wake = true});
}

template <class T> void change_step(Plan<T>& plan, State<T>& state, double dt) {
    state.time_since = time_of(plan, state);
    state.step_since = state.step;
    const T ratio = T(dt / plan.dt);
    plan.dt = dt;
    plan.stepper->change(plan, state, {.step = ratio, .wake = true});
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void scale_wood(Plan<T>&, State<T>&, double, double);                                                     \
    template void change_step(Plan<T>&, State<T>&, double);
#include "../base/instantiate.inc"

} // namespace bough
