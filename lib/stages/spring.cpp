#include "spring.h"
#include "joint.h"
#include "joint_limit.h"
#include "oscillator.h"
#include "root_term.h"
#include "turn_guard.h"
#include <Eigen/Cholesky>

namespace bough {

template <class T> void symmetric_eigen(Matrix3<T> A, Matrix3<T>& V, Vector3<T>& values) {
    V.setIdentity();
    constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    // Quadratic convergence: from the fourth sweep on nothing is left to turn in either precision.
    for (int sweep = 0; sweep < 6; ++sweep) {
        bool turned = false;
        for (const auto& [p, q] : pairs) {
            const T off = A(p, q);
            const T limit = std::numeric_limits<T>::epsilon() * std::sqrt(std::abs(A(p, p)) * std::abs(A(q, q))) / 8;
            if (!(std::abs(off) > limit)) continue;
            turned = true;
            const T tau = (A(q, q) - A(p, p)) / (2 * off);
            const T t = (tau >= 0 ? T(1) : T(-1)) / (std::abs(tau) + std::sqrt(1 + tau * tau));
            const T c = 1 / std::sqrt(1 + t * t), s = t * c;
            const int r = 3 - p - q;
            A(p, p) -= t * off;
            A(q, q) += t * off;
            A(p, q) = A(q, p) = 0;
            const T arp = A(r, p), arq = A(r, q);
            A(r, p) = A(p, r) = c * arp - s * arq;
            A(r, q) = A(q, r) = s * arp + c * arq;
            const Vector3<T> vp = V.col(p), vq = V.col(q);
            V.col(p) = c * vp - s * vq;
            V.col(q) = s * vp + c * vq;
        }
        if (!turned) break;
    }
    values = A.diagonal();
}

namespace {

// One joint at the start of its step, in the axes of its body.
template <class T> struct Joint {
    Matrix3<T> T_tb;       // rates of theta from the body's: J^-1
    Vector3<T> residual_b; // [N m] tau - T^T K theta
    Matrix3<T> K_b, KG_b;  // [N m/rad] T^T K T, and with gravity's gradient
    Vector3<T> held_b;     // [N m] of tau, what is held constant over the step: all but gravity
    Vector3<T> g_b, h_b;   // [m/s^2], [kg m] gravity and the composite's first moment
};

template <class T> Joint<T> load(const Plan<T>& plan, const State<T>& s, std::size_t i) {
    const Matrix3<T>& R_wb = s.R_wb[i];
    Joint<T> joint;
    joint.T_tb = body_rate_jacobian_inverse(s.theta[i]);
    joint.K_b = joint.T_tb.transpose() * plan.K[i].asDiagonal() * joint.T_tb;
    joint.KG_b = joint.K_b;
    Vector3<T> tau_w = Vector3<T>::Zero();
    if (plan.forces) tau_w += s.c_tau_w[i];
    const RootLoad<T>* root = plan.root_motion ? root_load_of(plan, s, i) : nullptr;
    joint.g_b = joint.h_b = Vector3<T>::Zero();
    if (plan.gravity || root) {
        Vector3<T> g_w = plan.scene.gravity.template cast<T>();
        T row = plan.gravity_row[i];
        if (root) {
            g_w = apparent_gravity(*root, s.x_w[i]);
            row *= g_w.norm() / plan.row_gravity;
            tau_w -= turning_moment(*root, s.c_J_w[i]);
            const Matrix3<T> J_b = R_wb.transpose() * s.c_J_w[i] * R_wb;
            joint.KG_b += turning_gradient<T>(J_b, R_wb.transpose() * root->omega, R_wb.transpose() * root->alpha);
        }
        const Vector3<T> g = R_wb.transpose() * g_w, h = R_wb.transpose() * s.c_h_w[i];
        joint.g_b = g;
        joint.h_b = h;
        const Matrix3<T> hg = h * g.transpose();
        joint.KG_b += (g.dot(h) + row) * Matrix3<T>::Identity() - T(0.5) * (hg + hg.transpose());
    }
    joint.held_b = R_wb.transpose() * tau_w;
    joint.residual_b =
        joint.held_b + joint.h_b.cross(joint.g_b) - joint.T_tb.transpose() * plan.K[i].cwiseProduct(s.theta[i]);
    return joint;
}

// What a turn of theta by phi_b has added to the joint's energy beyond the work of what is held, with its composite rigid:
// kinetic |w|^2 / 2, elastic, and gravity's exactly.
template <class T>
T energy_gained(const Plan<T>& plan, const Joint<T>& joint, std::size_t i, const Vector3<T>& theta,
                const Vector3<T>& next, T kinetic, const Vector3<T>& phi_b) {
    const Vector3<T> K = plan.K[i];
    const T elastic = (next - theta).dot(K.cwiseProduct(next + theta)) / 2;
    const Vector3<T> h = rotation_from_vector(Vector3<T>(-theta)) * (rotation_from_vector(next) * joint.h_b);
    return kinetic + elastic - joint.g_b.dot(h - joint.h_b) - joint.held_b.dot(phi_b);
}

template <class T> StepFlags evolve(const Plan<T>& plan, State<T>& s, std::size_t i, T h) {
    const Joint<T> joint = load(plan, s, i);
    const Matrix3<T> L = joint_inertia(plan, s, i).llt().matrixL();
    const auto lower = L.template triangularView<Eigen::Lower>();
    Matrix3<T> half = joint.KG_b;
    lower.solveInPlace(half);        // L^-1 (K + G)
    Matrix3<T> A = half.transpose(); // (K + G) L^-T, as K + G is symmetric
    lower.solveInPlace(A);
    A = (T(0.5) * (A + A.transpose())).eval();
    Matrix3<T> X;
    Vector3<T> lambda;
    symmetric_eigen(A, X, lambda);
    Matrix3<T> U = X;
    L.transpose().template triangularView<Eigen::Upper>().solveInPlace(U);

    const Vector3<T> r = U.transpose() * joint.residual_b;
    const Vector3<T> v = X.transpose() * s.scaled_rate[i]; // U^-1 theta_dot = X^T L^T theta_dot
    StepFlags flags;
    Vector3<T> dq, v_new;
    for (int k = 0; k < 3; ++k) {
        T b = plan.beta[i] * U.col(k).dot(joint.K_b * U.col(k));
        T l = lambda[k];
        T residual = r[k];
        if (l < 0) ++flags.buckling;
        if (plan.wind) {
            // The air's bounds are multiples of 1, which U makes U^T U: its rows are bounded by their sums in turn.
            const T row = (U.transpose() * U.col(k)).cwiseAbs().sum();
            const T d = row * plan.inverse_weight[i] * s.c_wind_row[i];
            b += d;
            l += row * s.c_turn_row[i];
            residual += d * v[k];
        }
        if (l > largest_lambda<T>()) {
            const T ratio = largest_lambda<T>() / l;
            b *= ratio;
            l *= ratio;
            residual *= ratio;
            ++flags.bounded_lambda;
        }
        const Propagator<T> p = propagate(b, l, h);
        dq[k] = p.E * residual + p.B * v[k];
        v_new[k] = p.B * residual + p.C * v[k];
    }
    const Vector3<T> phi = U * dq, next = s.theta[i] + joint.T_tb * phi;
    if (phi.squaredNorm() > T(guarded_turn) * T(guarded_turn)) {
        const T after = v_new.squaredNorm(), before = v.squaredNorm();
        const T excess = energy_gained(plan, joint, i, s.theta[i], next, (after - before) / 2, phi);
        if (excess > 0) {
            v_new *= std::sqrt(std::max(T(0), 1 - 2 * excess / after));
            ++flags.energy_guard;
        }
    }
    s.theta[i] = next;
    s.scaled_rate[i] = X * v_new;
    Vector3<T> omega_b = U * v_new;
    if (plan.joint_limit && stop_at_limit(plan.theta_limit[i], L, s.theta[i], s.scaled_rate[i])) {
        ++flags.limited;
        omega_b = s.scaled_rate[i];
        L.transpose().template triangularView<Eigen::Upper>().solveInPlace(omega_b);
    }
    if (shorten_rotation(s.theta[i])) ++flags.half_turns;
    s.theta_dot[i] = body_rate_jacobian_inverse(s.theta[i]) * omega_b;
    return flags;
}

} // namespace

template <class T> void spring_update(const Plan<T>& plan, State<T>& state) {
    const auto n = std::int64_t(plan.bodies);
    const T h = T(plan.dt);
    std::uint64_t buckling = 0, bounded = 0, half_turns = 0, guarded = 0, limited = 0;
#pragma omp parallel for schedule(static) reduction(+ : buckling, bounded, half_turns, guarded, limited) if (n > 2000)
    for (std::int64_t i = 0; i < n; ++i) {
        const StepFlags flags = evolve(plan, state, std::size_t(i), h);
        buckling += flags.buckling;
        bounded += flags.bounded_lambda;
        half_turns += flags.half_turns;
        guarded += flags.energy_guard;
        limited += flags.limited;
    }
    state.flags.buckling += buckling;
    state.flags.bounded_lambda += bounded;
    state.flags.half_turns += half_turns;
    state.flags.energy_guard += guarded;
    state.flags.limited += limited;
}

template <class T> void spring_torque(const Plan<T>& plan, State<T>& state) {
    for (std::size_t i = 0; i < state.torque_j.size(); ++i)
        state.torque_j[i] = -body_rate_jacobian_inverse(Vector3<T>(-state.theta[i])).transpose() *
                            plan.K[i].cwiseProduct(state.theta[i] + plan.beta[i] * state.theta_dot[i]);
}

template void symmetric_eigen(Matrix3<float>, Matrix3<float>&, Vector3<float>&);
template void symmetric_eigen(Matrix3<double>, Matrix3<double>&, Vector3<double>&);
template void spring_update(const Plan<float>&, State<float>&);
template void spring_update(const Plan<double>&, State<double>&);
template void spring_torque(const Plan<float>&, State<float>&);
template void spring_torque(const Plan<double>&, State<double>&);

} // namespace bough
