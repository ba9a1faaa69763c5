#include "drag.h"
#include "../base/parallel.h"
#include "joint.h"
#include <Eigen/Cholesky>

namespace bough {

template <class T> void joint_drag(const Plan<T>& plan, State<T>& state, std::size_t i) {
    const T h = T(plan.dt);
    const Vector3<T> tau_b = state.R_wb[i].transpose() * state.c_drag_tau_w[i];
    const Matrix3<T> S = joint_inertia(plan, state, i);
    const Matrix3<T> L = S.llt().matrixL();
    Matrix3<T> N = S;
    N.diagonal().array() += h * plan.inverse_weight[i] * state.c_drag_row[i];
    const Vector3<T> change = h * N.llt().solve(tau_b);
    state.scaled_rate[i] += L.transpose() * change;
}

template <class T> void joint_drag(const Plan<T>& plan, State<T>& state) {
    parallel_for(plan.bodies, 100, [&](std::size_t i) { joint_drag(plan, state, i); });
}

template void joint_drag(const Plan<float>&, State<float>&, std::size_t);
template void joint_drag(const Plan<double>&, State<double>&, std::size_t);
template void joint_drag(const Plan<float>&, State<float>&);
template void joint_drag(const Plan<double>&, State<double>&);

} // namespace bough
