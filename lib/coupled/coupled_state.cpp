#include "coupled_state.h"
#include "../plan/carried.h"
#include <stdexcept>

namespace bough {

template <class T> std::size_t CoupledWork<T>::bytes() const {
    const auto of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return of(this->theta_change) + of(this->theta_dot_change) + of(coupled) + of(resolvent) + of(resolvent_real) +
           of(guard) + this->attachments.bytes();
}

template <class T> void take_coupled_constants(const Plan<T>& plan, const Tree& tree, CoupledPlan<T>& own) {
    if (plan.gravity) own.carried_moment = in_precision<T>(carried_moments(plan, tree));
    if (plan.wind) own.carried_drag = in_precision<T>(carried_drag(plan, tree));
}

template <class T>
void allocate_coupled(const Plan<T>& plan, State<T>& state, CoupledState<T>& own, std::size_t roots) {
    if (plan.pose) {
        own.theta_change.assign(plan.bodies, Vector3<T>::Zero());
        own.theta_dot_change.assign(plan.bodies, Vector3<T>::Zero());
    }
    if (plan.wind) state.wind = make_wind_table<T>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    if (plan.field)
        own.wind_start = own.wind_end = state.wind.field;
    else
        own.wind_change = state.wind;
    own.ground.resize(plan.splines.size());
    own.account.resize(roots);
}

void refuse_with_coupled(const Scene& scene) {
    if (scene.fictitious)
        throw std::domain_error("fictitious: only for solver analytic; solver coupled has these terms by nature, whole "
                                "and in time");
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template struct CoupledWork<T>;                                                                                    \
    template void take_coupled_constants(const Plan<T>&, const Tree&, CoupledPlan<T>&);                                \
    template void allocate_coupled(const Plan<T>&, State<T>&, CoupledState<T>&, std::size_t);
#include "../base/instantiate.inc"

} // namespace bough
