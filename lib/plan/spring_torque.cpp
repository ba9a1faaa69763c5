#include "spring_torque.h"

namespace bough {

template <class T> void spring_torque(const Plan<T>& plan, State<T>& state) {
    for (std::size_t i = 0; i < state.torque_j.size(); ++i)
        state.torque_j[i] = -body_rate_jacobian_inverse(Vector3<T>(-state.theta[i])).transpose() *
                            plan.K[i].cwiseProduct(state.theta[i] + plan.beta[i] * state.theta_dot[i]);
}

template void spring_torque(const Plan<float>&, State<float>&);
template void spring_torque(const Plan<double>&, State<double>&);

} // namespace bough
