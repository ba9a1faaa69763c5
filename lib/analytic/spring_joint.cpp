#include "spring_joint.h"
#include "../base/cholesky.h"
#include "../base/symmetric_eigen.h"
#include "../laws/turn_guard.h"
#include "joint.h"
#include "root_term.h"

namespace bough {

template <class T>
SpringJoint<T> spring_joint(const Plan<T>& plan, const AnalyticPlan<T>& own, const State<T>& s,
                            const AnalyticWork<T>& work, std::size_t i) {
    const Matrix3<T>& R_wb = s.R_wb[i];
    SpringJoint<T> joint;
    joint.T_tb = body_rate_jacobian_inverse(s.theta[i]);
    joint.K_b = joint.T_tb.transpose() * plan.K[i].asDiagonal() * joint.T_tb;
    joint.KG_b = joint.K_b;
    Vector3<T> tau_w = Vector3<T>::Zero();
    if (plan.forces) tau_w += work.c_tau_w[i];
    if (own.fictitious) tau_w += work.fictitious_w[i];
    if (work.held.any()) {
        tau_w += work.held_tau_w[i];
        joint.KG_b.diagonal().array() += work.held_row[i];
    }
    const RootLoad<T>* root = plan.root_motion ? root_load_of(plan, work, i) : nullptr;
    joint.g_b = joint.h_b = Vector3<T>::Zero();
    if (plan.gravity || root) {
        Vector3<T> g_w = plan.scene.gravity.template cast<T>();
        T row = own.gravity_row[i];
        if (root) {
            g_w = apparent_gravity(*root, s.x_w[i]);
            row *= g_w.norm() / own.row_gravity;
            tau_w -= turning_moment(*root, work.c_J_w[i]);
            const Matrix3<T> J_b = R_wb.transpose() * work.c_J_w[i] * R_wb;
            joint.KG_b += turning_gradient<T>(J_b, R_wb.transpose() * root->omega, R_wb.transpose() * root->alpha);
        }
        const Vector3<T> g = R_wb.transpose() * g_w, h = R_wb.transpose() * work.c_h_w[i];
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

template <class T>
SpringOscillators<T> spring_oscillators(const Plan<T>& plan, const AnalyticPlan<T>& own, const State<T>& s,
                                        const AnalyticWork<T>& work, const SpringJoint<T>& joint, std::size_t i) {
    SpringOscillators<T> o;
    o.L = Cholesky<T>(joint_inertia(own, s, work, i)).L;
    Matrix3<T> half = joint.KG_b;
    solve_lower(o.L, half);          // L^-1 (K + G)
    Matrix3<T> A = half.transpose(); // (K + G) L^-T, as K + G is symmetric
    solve_lower(o.L, A);
    A = (T(0.5) * (A + A.transpose())).eval();
    symmetric_eigen(A, o.X, o.lambda);
    o.U = o.X;
    solve_lower_transposed(o.L, o.U);
    for (int k = 0; k < 3; ++k) {
        o.b[k] = plan.beta[i] * o.U.col(k).dot(joint.K_b * o.U.col(k));
        o.d[k] = 0;
        o.ratio[k] = 1;
        o.row[k] = o.U.col(k).squaredNorm();
        T& l = o.lambda[k];
        if (l < 0) ++o.buckling;
        if (plan.wind) {
            // The air's bounds are multiples of 1, which U makes U^T U: its rows are bounded by their sums in turn.
            o.row[k] = (o.U.transpose() * o.U.col(k)).cwiseAbs().sum();
            o.d[k] = o.row[k] * own.inverse_weight[i] * work.c_wind_row[i];
            o.b[k] += o.d[k];
            l += o.row[k] * work.c_turn_row[i];
        }
        if (l > largest_lambda<T>()) {
            o.ratio[k] = largest_lambda<T>() / l;
            o.b[k] *= o.ratio[k];
            l *= o.ratio[k];
            ++o.bounded;
        }
        o.step[k] = propagate(o.b[k], l, T(plan.dt));
    }
    return o;
}

namespace {

// What a turn of theta by phi_b has added to the joint's energy beyond the work of what is held, with its composite rigid:
// kinetic |w|^2 / 2, elastic, and gravity's exactly.
template <class T>
T energy_gained(const Plan<T>& plan, const SpringJoint<T>& joint, std::size_t i, const Vector3<T>& theta,
                const Vector3<T>& next, T kinetic, const Vector3<T>& phi_b) {
    const Vector3<T> K = plan.K[i];
    const T elastic = (next - theta).dot(K.cwiseProduct(next + theta)) / 2;
    const Vector3<T> h = rotation_from_vector(Vector3<T>(-theta)) * (rotation_from_vector(next) * joint.h_b);
    return kinetic + elastic - joint.g_b.dot(h - joint.h_b) - joint.held_b.dot(phi_b);
}

} // namespace

template <class T>
T kept_of_rate(const Plan<T>& plan, const SpringJoint<T>& joint, std::size_t i, const Vector3<T>& theta,
               const Vector3<T>& next, const Vector3<T>& phi_b, const Vector3<T>& before, const Vector3<T>& after,
               StepFlags& flags) {
    if (!(phi_b.squaredNorm() > T(guarded_turn) * T(guarded_turn))) return 1;
    const T kinetic = after.squaredNorm();
    const T excess = energy_gained(plan, joint, i, theta, next, (kinetic - before.squaredNorm()) / 2, phi_b);
    if (!(excess > 0)) return 1;
    ++flags.energy_guard;
    return std::sqrt(std::max(T(0), 1 - 2 * excess / kinetic));
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template SpringJoint<T> spring_joint(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&,                      \
                                         const AnalyticWork<T>&, std::size_t);                                         \
    template SpringOscillators<T> spring_oscillators(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&,          \
                                                     const AnalyticWork<T>&, const SpringJoint<T>&, std::size_t);      \
    template T kept_of_rate(const Plan<T>&, const SpringJoint<T>&, std::size_t, const Vector3<T>&, const Vector3<T>&,  \
                            const Vector3<T>&, const Vector3<T>&, const Vector3<T>&, StepFlags&);
#include "../base/instantiate.inc"

} // namespace bough
