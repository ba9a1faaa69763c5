#include "frozen.h"
#include "../fast/frozen_lanes.h"
#include "drag.h"
#include "spring.h"
#include "spring_joint.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace bough {
namespace {

// What the coefficients are held against.
template <class T> struct Seen {
    Matrix3<T> J_p;
    T gravity = 0, wind = 0;
};

template <class T> Seen<T> see(const Plan<T>& plan, const State<T>& s, std::size_t i) {
    const T h = T(plan.dt);
    const Matrix3<T> R_pw = plan.R_pj[i] * rotation_from_vector(s.theta[i]) * s.R_wb[i].transpose();
    Seen<T> seen;
    seen.J_p = R_pw * s.c_J_w[i] * R_pw.transpose();
    if (plan.gravity) seen.gravity = h * h * s.c_h_w[i].dot(plan.scene.gravity.template cast<T>());
    if (plan.wind) seen.wind = h * (plan.inverse_weight[i] * s.c_wind_row[i]) + h * h * s.c_turn_row[i];
    return seen;
}

template <class T> Matrix3<T> inertia_then(const FrozenJoint<T>& f) {
    Matrix3<T> J;
    J << f.J[0], f.J[1], f.J[2], f.J[1], f.J[3], f.J[4], f.J[2], f.J[4], f.J[5];
    return J;
}

template <class T> bool stale(const FrozenJoint<T>& f, const Seen<T>& seen, T tolerance) {
    const Matrix3<T> J = inertia_then(f);
    if ((seen.J_p - J).cwiseAbs().maxCoeff() > tolerance / 2 * J.trace()) return true;
    const T change = std::max(std::abs(seen.gravity - f.gravity), std::abs(seen.wind - f.wind));
    return f.sensitivity * change > T(frozen_load_share) * tolerance;
}

// w of the modes' rates v.
template <class T> Vector3<T> scaled_rate_of(const Matrix3<T>& U, const Vector3<T>& v) {
    // U U^T = M M^T from its last row up: Cholesky's of the matrix with rows and columns reversed.
    const Matrix3<T> P = (U * U.transpose()).reverse();
    const Matrix3<T> M = Matrix3<T>(P.llt().matrixL()).reverse();
    const Vector3<T> w = M.template triangularView<Eigen::Upper>().solve(U * v);
    const T is = w.norm();
    return is > 0 ? Vector3<T>(v.norm() / is * w) : w;
}

template <class T> void make(const Plan<T>& plan, State<T>& s, std::size_t i, const Seen<T>& seen, StepFlags& flags) {
    FrozenJoint<T>& f = s.frozen[i];
    const SpringOscillators<T> o = spring_oscillators(plan, s, spring_joint(plan, s, i), i);
    const Vector3<T> w = f.J[0] + f.J[3] + f.J[5] > 0 ? scaled_rate_of(f.U, s.scaled_rate[i]) : s.scaled_rate[i];
    s.scaled_rate[i] = o.X.transpose() * w;
    f.U = o.U;
    f.sensitivity = 0;
    const T h = T(plan.dt);
    for (int k = 0; k < 3; ++k) {
        f.E[k] = o.ratio[k] * o.step[k].E;
        f.B[k] = o.ratio[k] * o.step[k].B;
        f.carry[k] = o.step[k].B + f.E[k] * o.d[k];
        f.C[k] = o.step[k].C + f.B[k] * o.d[k];
        f.sensitivity = std::max(f.sensitivity, o.row[k] / (1 + std::abs(o.lambda[k]) * h * h + std::abs(o.b[k]) * h));
    }
    const T J[6] = {seen.J_p(0, 0), seen.J_p(0, 1), seen.J_p(0, 2), seen.J_p(1, 1), seen.J_p(1, 2), seen.J_p(2, 2)};
    std::copy(J, J + 6, f.J);
    f.gravity = seen.gravity;
    f.wind = seen.wind;
    flags.buckling += o.buckling;
    flags.bounded_lambda += o.bounded;
    ++flags.refreshed;
}

template <class T> StepFlags evolve(const Plan<T>& plan, State<T>& s, std::size_t i) {
    const T h = T(plan.dt);
    const FrozenJoint<T>& f = s.frozen[i];
    const SpringJoint<T> joint = spring_joint(plan, s, i);
    StepFlags flags;
    Vector3<T> v = s.scaled_rate[i];
    if (plan.wind) {
        const T d = plan.inverse_weight[i] * s.c_drag_row[i];
        const Matrix3<T> N = Matrix3<T>::Identity() + h * d * (f.U.transpose() * f.U);
        v += h * N.llt().solve(f.U.transpose() * (s.R_wb[i].transpose() * s.c_drag_tau_w[i]));
    }
    const Vector3<T> r = f.U.transpose() * joint.residual_b;
    const Vector3<T> phi = f.U * (f.E.cwiseProduct(r) + f.carry.cwiseProduct(v));
    Vector3<T> v_new = f.B.cwiseProduct(r) + f.C.cwiseProduct(v);
    const Vector3<T> next = s.theta[i] + joint.T_tb * phi;
    v_new *= kept_of_rate(plan, joint, i, s.theta[i], next, phi, v, v_new, flags);
    s.theta[i] = next;
    s.scaled_rate[i] = v_new;
    if (shorten_rotation(s.theta[i])) ++flags.half_turns;
    s.theta_dot[i] = body_rate_jacobian_inverse(s.theta[i]) * (f.U * v_new);
    return flags;
}

} // namespace

template <class T> void refresh_joints(const Plan<T>& plan, State<T>& state) {
    const auto n = std::int64_t(plan.bodies);
    std::uint64_t refreshed = 0, buckling = 0, bounded = 0;
#pragma omp parallel for schedule(static) reduction(+ : refreshed, buckling, bounded) if (n > 2000)
    for (std::int64_t k = 0; k < n; ++k) {
        const auto i = std::size_t(k);
        if (!keeps_coefficients(plan, i)) continue;
        const Seen<T> seen = see(plan, state, i);
        if (!stale(state.frozen[i], seen, T(plan.refresh))) continue;
        StepFlags flags;
        make(plan, state, i, seen, flags);
        refreshed += flags.refreshed;
        buckling += flags.buckling;
        bounded += flags.bounded_lambda;
    }
    state.flags.refreshed += refreshed;
    state.flags.buckling += buckling;
    state.flags.bounded_lambda += bounded;
}

template <class T> void frozen_update(const Plan<T>& plan, State<T>& state) {
    const auto n = std::int64_t(plan.bodies);
    std::uint64_t half_turns = 0, guarded = 0, buckling = 0, bounded = 0;
#pragma omp parallel for schedule(static) reduction(+ : half_turns, guarded, buckling, bounded) if (n > 2000)
    for (std::int64_t k = 0; k < n; ++k) {
        const auto i = std::size_t(k);
        StepFlags flags;
        if (keeps_coefficients(plan, i)) {
            flags = evolve(plan, state, i);
        } else {
            joint_drag(plan, state, i);
            flags = spring_update(plan, state, i);
        }
        half_turns += flags.half_turns;
        guarded += flags.energy_guard;
        buckling += flags.buckling;
        bounded += flags.bounded_lambda;
    }
    state.flags.half_turns += half_turns;
    state.flags.buckling += buckling;
    state.flags.bounded_lambda += bounded;
    state.flags.energy_guard += guarded;
}

template <class T> std::vector<double> saved_frozen(const Plan<T>& plan, const State<T>& state) {
    std::vector<double> values;
    if (!(plan.refresh > 0)) return values;
    constexpr int reals = FrozenJoint<T>::reals;
    static_assert(sizeof(FrozenJoint<T>) == reals * sizeof(T));
    values.resize(plan.bodies * reals);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        T at[reals];
        if (plan.lanes.on)
            fast::read_frozen(plan, state, i, at);
        else
            std::memcpy(at, &state.frozen[i], sizeof at);
        std::copy(at, at + reals, values.begin() + std::ptrdiff_t(i * reals));
    }
    return values;
}

template <class T> void restore_frozen(const Plan<T>& plan, State<T>& state, const std::vector<double>& values) {
    constexpr int reals = FrozenJoint<T>::reals;
    if (!(plan.refresh > 0)) throw std::invalid_argument("this run keeps no coefficients");
    if (values.size() != plan.bodies * reals)
        throw std::invalid_argument("holds " + std::to_string(values.size()) + " numbers, expected " +
                                    std::to_string(reals) + " for each of " + std::to_string(plan.bodies) + " bodies");
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k])) throw std::invalid_argument("number " + std::to_string(k) + " is not finite");
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        T at[reals];
        for (int k = 0; k < reals; ++k) at[k] = T(values[i * reals + std::size_t(k)]);
        FrozenJoint<T> joint;
        std::memcpy(static_cast<void*>(&joint), at, sizeof at);
        const T trace = joint.J[0] + joint.J[3] + joint.J[5];
        if (!(trace == 0 || (trace > 0 && joint.U.allFinite() && joint.U.determinant() != 0 && joint.sensitivity >= 0)))
            throw std::invalid_argument("body " + std::to_string(i) + " has modes or an inertia that no joint has");
        if (plan.lanes.on)
            fast::write_frozen(plan, state, i, at);
        else
            std::memcpy(static_cast<void*>(&state.frozen[i]), at, sizeof at);
    }
}

template void refresh_joints(const Plan<float>&, State<float>&);
template void refresh_joints(const Plan<double>&, State<double>&);
template void frozen_update(const Plan<float>&, State<float>&);
template void frozen_update(const Plan<double>&, State<double>&);
template std::vector<double> saved_frozen(const Plan<float>&, const State<float>&);
template std::vector<double> saved_frozen(const Plan<double>&, const State<double>&);
template void restore_frozen(const Plan<float>&, State<float>&, const std::vector<double>&);
template void restore_frozen(const Plan<double>&, State<double>&, const std::vector<double>&);

} // namespace bough
