#include "drag.h"
#include "../base/cholesky.h"
#include "../base/parallel.h"
#include "joint.h"

namespace bough {

template <class T>
void joint_drag(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work,
                std::size_t i) {
    const T h = T(plan.dt);
    const Vector3<T> tau_b = state.R_wb[i].transpose() * work.c_drag_tau_w[i];
    const Matrix3<T> S = joint_inertia(own, state, work, i);
    const Matrix3<T> L = Cholesky<T>(S).L;
    Matrix3<T> N = S;
    N.diagonal().array() += h * own.inverse_weight[i] * work.c_drag_row[i];
    const Vector3<T> change = h * Cholesky<T>(N).solve(tau_b);
    work.scaled_rate[i] += L.transpose() * change;
}

template <class T>
void joint_drag(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work) {
    parallel_for(plan.bodies, 100, [&](std::size_t i) { joint_drag(plan, own, state, work, i); });
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void joint_drag(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, std::size_t);        \
    template void joint_drag(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&);
#include "../base/instantiate.inc"

} // namespace bough
