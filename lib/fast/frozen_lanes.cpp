#include "frozen_lanes.h"
#include "../stages/frozen_joint.h"
#include "analytic_rows.h"
#include "lane_memory.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace bough::fast {
namespace {

static_assert(FrozenJoint<double>::reals == analytic::frozen::count);

// L^-T of each joint's S (joint.h), in body axes.
template <class T> std::vector<Matrix3<T>> modes_at_rest(const Plan<T>& plan, const State<T>& state) {
    std::vector<Matrix3<T>> U(plan.bodies), J(plan.inertia_joint);
    std::vector<Vector3<T>> h(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) h[i] = plan.mass[i] * plan.com[i];
    for (std::size_t i = plan.bodies; i-- > 0;) {
        Matrix3<T> S = J[i];
        const Vector3<T>& f = plan.inertia_factor[i];
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) S(r, c) *= f[r] * f[c];
        S.diagonal().array() += 4 * std::numeric_limits<T>::epsilon() * S.trace();
        U[i].setIdentity();
        const Matrix3<T> L = S.llt().matrixL();
        L.transpose().template triangularView<Eigen::Upper>().solveInPlace(U[i]);
        if (plan.parent[i] < 0) continue;
        const auto p = std::size_t(plan.parent[i]);
        const Matrix3<T> R = plan.R_pj[i] * rotation_from_vector(state.theta[i]);
        const Vector3<T>& r = plan.joint_position[i];
        const Vector3<T> q = R * h[i] + plan.c_mass[i] / 2 * r;
        const Matrix3<T> outer = r * q.transpose();
        J[p] += R * J[i] * R.transpose() + 2 * r.dot(q) * Matrix3<T>::Identity() - outer - outer.transpose();
        h[p] += R * h[i] + plan.c_mass[i] * r;
    }
    return U;
}

} // namespace

template <class T> void start_frozen(const Plan<T>& plan, State<T>& state) {
    const Layout& layout = plan.lanes.layout;
    const Matrix3<T> one = Matrix3<T>::Identity();
    const bool moves = plan.pose && std::any_of(state.scaled_rate.begin(), state.scaled_rate.end(),
                                                [](const Vector3<T>& rate) { return !rate.isZero(0); });
    const std::vector<Matrix3<T>> modes = moves ? modes_at_rest(plan, state) : std::vector<Matrix3<T>>();
    RowVector<T>& rows = state.lanes.frozen;
    rows.resize(std::size_t(layout.rows) * analytic::frozen::count);
    for (std::size_t slot = 0; slot < layout.body.size(); ++slot) {
        const Slot<T> row(rows, analytic::frozen::count, slot);
        const Vector3<T> a = row.vector(analytic::frozen::J), b = row.vector(analytic::frozen::J + 3);
        if (a[0] + b[0] + b[2] > 0) continue; // they are there
        const std::int32_t body = layout.body[slot];
        const Matrix3<T>& U = moves && body >= 0 ? modes[std::size_t(body)] : one;
        for (int k = 0; k < 3; ++k) row.put(analytic::frozen::U + 3 * k, Vector3<T>(U.col(k)));
    }
}

template <class T> void read_frozen(const Plan<T>& plan, const State<T>& state, std::size_t body, T* numbers) {
    const std::size_t slot = plan.lanes.layout.slot[body];
    for (int k = 0; k < analytic::frozen::count; ++k)
        numbers[k] = state.lanes.frozen[slot / Row<T>::lanes * analytic::frozen::count + std::size_t(k)]
                         .lane[slot % Row<T>::lanes];
}

template <class T> void write_frozen(const Plan<T>& plan, State<T>& state, std::size_t body, const T* numbers) {
    const Slot<T> row(state.lanes.frozen, analytic::frozen::count, plan.lanes.layout.slot[body]);
    for (int k = 0; k < analytic::frozen::count; ++k) row.put(k, numbers[k]);
}

template void start_frozen(const Plan<float>&, State<float>&);
template void start_frozen(const Plan<double>&, State<double>&);
template void read_frozen(const Plan<float>&, const State<float>&, std::size_t, float*);
template void read_frozen(const Plan<double>&, const State<double>&, std::size_t, double*);
template void write_frozen(const Plan<float>&, State<float>&, std::size_t, const float*);
template void write_frozen(const Plan<double>&, State<double>&, std::size_t, const double*);

} // namespace bough::fast
