#include "coupled_state.h"
#include "../plan/carried.h"
#include <stdexcept>

namespace bough {

template <class T> std::size_t CoupledWork<T>::bytes() const {
    const auto of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return of(this->theta_change) + of(this->theta_dot_change) + of(coupled) + of(resolvent) + of(resolvent_real) +
           of(guard);
}

template <class T> void take_coupled_constants(const Plan<T>& plan, const Tree& tree, CoupledPlan<T>& own) {
    if (plan.gravity) own.carried_moment = in_precision<T>(carried_moments(plan, tree));
    if (plan.wind) own.carried_drag = in_precision<T>(carried_drag(plan, tree));
}

void refuse_with_coupled(const Scene& scene) {
    if (scene.fictitious)
        throw std::domain_error("fictitious: only for solver analytic; solver coupled has these terms by nature, whole "
                                "and in time");
}

template struct CoupledWork<float>;
template struct CoupledWork<double>;
template void take_coupled_constants(const Plan<float>&, const Tree&, CoupledPlan<float>&);
template void take_coupled_constants(const Plan<double>&, const Tree&, CoupledPlan<double>&);

} // namespace bough
