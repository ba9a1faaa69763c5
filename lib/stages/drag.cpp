#include "drag.h"
#include "joint.h"
#include <Eigen/Cholesky>

namespace bough {

template <class T> void joint_drag(const Plan<T>& plan, State<T>& state) {
    const auto n = std::int64_t(plan.bodies);
    const T h = T(plan.dt);
#pragma omp parallel for schedule(static) if (n > 2000)
    for (std::int64_t k = 0; k < n; ++k) {
        const auto i = std::size_t(k);
        const Matrix3<T> R_wj = joint_frame(plan, state, i);
        const Vector3<T> tau = R_wj.transpose() * state.c_drag_tau_w[i];
        Matrix3<T> N = joint_inertia(plan, state, i, R_wj);
        N.diagonal().array() += h * plan.inverse_weight[i] * state.c_drag_row[i];
        state.theta_dot[i] += h * Vector3<T>(N.llt().solve(tau));
    }
}

template void joint_drag(const Plan<float>&, State<float>&);
template void joint_drag(const Plan<double>&, State<double>&);

} // namespace bough
