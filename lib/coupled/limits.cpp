#include "limits.h"
#include "articulated_algebra.h"
#include "midpoint.h"

namespace bough {
namespace {

// Clamps theta; 1 for each component that pushes on, else 0.
template <class T> Vector3<T> clamp(const Plan<T>& plan, State<T>& state, std::size_t i, bool& past) {
    Vector3<T>& theta = state.theta[i];
    const Vector3<T>& limit = plan.theta_limit[i];
    Vector3<T> pushing = Vector3<T>::Zero();
    if (!theta.allFinite()) return pushing; // to be found, not hidden
    for (int k = 0; k < 3; ++k) {
        if (!(std::abs(theta[k]) > limit[k])) continue;
        past = true;
        theta[k] = std::copysign(limit[k], theta[k]);
        if (theta[k] * state.theta_dot[i][k] > 0) pushing[k] = 1;
    }
    return pushing;
}

template <class T> void stop(const Plan<T>& plan, State<T>& state, CoupledWork<T>& work) {
    constexpr T stiff = sizeof(T) == 4 ? T(1e3) : T(1e6);
    std::vector<ResolventBody<T>>& body = work.resolvent_real;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const CoupledBody<T>& b = work.coupled[i];
        ResolventBody<T>& q = body[i];
        q.A = b.R * plan.inertia_joint[i] * b.R.transpose();
        q.A.diagonal().array() += 4 * std::numeric_limits<T>::epsilon() * q.A.trace();
        q.B = plan.mass[i] * cross_matrix(b.c);
        q.M = plan.mass[i] * Matrix3<T>::Identity();
        q.N.setZero();
        q.F.setZero();
    }
    for (std::size_t i = plan.bodies; i-- > 0;) {
        const CoupledBody<T>& b = work.coupled[i];
        ResolventBody<T>& q = body[i];
        const Vector3<T> lock = stiff * q.A.trace() * work.theta_change[i]; // 1 where it pushes
        const Matrix3<T> Z = b.rates.transpose() * lock.asDiagonal() * b.rates;
        q.E = symmetric_inverse(Matrix3<T>(q.A + Z));
        q.u = -b.rates.transpose() * lock.cwiseProduct(state.theta_dot[i]) - q.N;
        if (plan.parent[i] >= 0) hand_on(q, T(1), Z, b.r, body[std::size_t(plan.parent[i])]);
    }
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const CoupledBody<T>& b = work.coupled[i];
        const ResolventBody<T>* const p = plan.parent[i] < 0 ? nullptr : &body[std::size_t(plan.parent[i])];
        const Vector3<T> none = Vector3<T>::Zero();
        state.theta_dot[i] += b.rates * accelerate_joint(body[i], b.r, p ? p->alpha : none, p ? p->a : none);
        for (int k = 0; k < 3; ++k)
            if (work.theta_change[i][k] > 0) state.theta_dot[i][k] = 0;
    }
}

} // namespace

template <class T> bool keep_limits(const Plan<T>& plan, State<T>& state, CoupledWork<T>& work) {
    bool any = false;
    for (std::size_t i = 0; i < plan.bodies && !any; ++i)
        any = (state.theta[i].cwiseAbs().array() > plan.theta_limit[i].array()).any();
    if (!any) return false;
    // The last changes are dropped for the whole tree, whose rates the impulse changes; till then they mark what pushes.
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        bool past = false;
        work.theta_change[i] = clamp(plan, state, i, past);
        if (past) ++state.flags.limited;
    }
    const std::uint64_t fast = state.flags.fast_turns;
    midpoint(plan, state, work, false);
    state.flags.fast_turns = fast; // the step has counted its own
    stop(plan, state, work);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        work.theta_change[i] = T(plan.dt) * state.theta_dot[i];
        work.theta_dot_change[i].setZero();
    }
    return true;
}

#define BOUGH_INSTANTIATE(T) template bool keep_limits(const Plan<T>&, State<T>&, CoupledWork<T>&);
#include "../base/instantiate.inc"

} // namespace bough
