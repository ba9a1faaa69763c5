#include "spring_torque.h"

namespace bough {

template <class T> void spring_torque(const Plan<T>& plan, State<T>& state) {
    for (std::size_t i = 0; i < state.torque_j.size(); ++i)
        state.torque_j[i] = -body_rate_jacobian_inverse(Vector3<T>(-state.theta[i])).transpose() *
                            plan.K[i].cwiseProduct(state.theta[i] + plan.beta[i] * state.theta_dot[i]);
}

template <class T> void bending_stresses(const Plan<T>& plan, const State<T>& state, std::vector<double>& stress) {
    stress.resize(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i)
        stress[i] = double(state.torque_j[i].template head<2>().norm() * plan.stress_of_moment[i]);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void spring_torque(const Plan<T>&, State<T>&);                                                            \
    template void bending_stresses(const Plan<T>&, const State<T>&, std::vector<double>&);
#include "../base/instantiate.inc"

} // namespace bough
