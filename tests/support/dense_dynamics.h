// dense_dynamics.h: joint accelerations of a small tree by virtual work and one dense solve, in long double: a truth
// for articulated-body passes that shares nothing with them but the statement of the problem.
//
// Kane's equations in the body rates w of all joints. A rate of joint k moves body i of its subtree with
//   J_omega = R_k,  J_v = -[c_i - x_k] R_k      (c_i: centre of mass)
// Accelerations with w' = 0 are second differences of the poses along R_k exp(s w_k), theta_dot = T w with T by differences
// of the rotation's logarithm, the air's damping of round bodies by differences of its force: 8th order, h = 1e-3.
// h > 0: the linearly implicit system that lib/study/articulated.h states, for turns of less than a radian in h.
#pragma once
#include "lib/study/solvers.h"
#include "tests/support/solver_parts.h"
#include <Eigen/LU>
#include <functional>
#include <vector>

namespace dense {

using bough::operator+, bough::operator-, bough::operator*, bough::operator/; // eager.h: 3x3, for the compiler's time
using Real = long double;
using V3 = Eigen::Matrix<Real, 3, 1>;
using M3 = Eigen::Matrix<Real, 3, 3>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// Derivatives at 0 of a function of s.
constexpr Real step = 1e-3L;
template <class F> auto first_derivative(F f) {
    const Real c[] = {4.0L / 5, -1.0L / 5, 4.0L / 105, -1.0L / 280};
    auto sum = (f(step) - f(-step)).eval();
    sum *= c[0];
    for (int k = 2; k <= 4; ++k) sum += c[k - 1] * (f(k * step) - f(-k * step));
    return (sum / step).eval();
}
template <class F> auto second_derivative(F f) {
    const Real c[] = {8.0L / 5, -1.0L / 5, 8.0L / 315, -1.0L / 560};
    auto sum = (-205.0L / 72 * f(0)).eval();
    for (int k = 1; k <= 4; ++k) sum += c[k - 1] * (f(k * step) + f(-k * step));
    return (sum / (step * step)).eval();
}

inline Eigen::Quaternion<Real> turned(const V3& v) {
    const Real a = v.norm();
    return a > 0 ? Eigen::Quaternion<Real>(Eigen::AngleAxis<Real>(a, V3(v / a))) : Eigen::Quaternion<Real>::Identity();
}
inline V3 logarithm(const Eigen::Quaternion<Real>& q) {
    const Real n = q.vec().norm();
    return n > 0 ? V3(2 * std::atan2(n, q.w()) / n * q.vec()) : V3(V3::Zero());
}
inline M3 cross(const V3& r) {
    M3 m;
    m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
    return m;
}

// The ground: turned about the pivot at a steady omega since time 0, displaced by v t + a t^2 / 2.
struct GroundMotion {
    V3 v = V3::Zero(), a = V3::Zero(), omega = V3::Zero(), pivot = V3::Zero();
    M3 R(Real t) const { return turned(omega * t).toRotationMatrix(); }
    V3 x(Real t) const { return pivot + v * t + a * (t * t / 2) - R(t) * pivot; } // where the world's origin is
};

struct Problem {
    const bough::Tree& tree;         // unloaded as drawn
    const bough::Plan<double>& plan; // of it: gravity, pulls with their places, drag areas
    std::vector<bough::Vec3> theta, rate;
    Real time = 0;
    bool air = false;
    V3 wind = V3::Zero();    // everywhere, at the time that the air is taken
    std::vector<V3> pulls{}; // [N] of plan.pulls, likewise
    GroundMotion ground{};   // a alone where h > 0
    Real h = 0;
};

struct Pose {
    std::vector<M3> R;
    std::vector<V3> x, c; // joints, centres of mass
};

inline Pose pose_at(const Problem& p, Real s) {
    const std::size_t n = p.tree.size_bodies();
    Pose pose{std::vector<M3>(n), std::vector<V3>(n), std::vector<V3>(n)};
    for (std::size_t i = 0; i < n; ++i) {
        const bool root = p.tree.parent[i] < 0;
        const auto q = std::size_t(p.tree.parent[i]);
        const M3 R_w = root ? p.ground.R(p.time + s) : pose.R[q];
        const M3 R_pj = p.tree.joint_rotation[i].cast<Real>().normalized().toRotationMatrix();
        pose.R[i] = R_w * R_pj * turned(p.theta[i].cast<Real>()).toRotationMatrix() *
                    turned(s * p.rate[i].cast<Real>()).toRotationMatrix();
        pose.x[i] = (root ? p.ground.x(p.time + s) : pose.x[q]) + R_w * p.tree.joint_position[i].cast<Real>();
        pose.c[i] = pose.x[i] + pose.R[i] * p.tree.com[i].cast<Real>();
    }
    return pose;
}

inline Vector centres(const Problem& p, Real s) {
    const Pose pose = pose_at(p, s);
    Vector all(3 * Eigen::Index(pose.c.size()));
    for (std::size_t i = 0; i < pose.c.size(); ++i) all.segment<3>(3 * Eigen::Index(i)) = pose.c[i];
    return all;
}

// (21)-(23) over kappa rho A; a leaf with a quarter of its drag from all sides, folding at 7.5 m/s.
inline V3 air_force(bough::Kind kind, const M3& R, const V3& u) {
    if (kind == bough::Kind::fruit) return u.norm() * u;
    if (bough::is_flat(kind)) {
        const V3 along = u.dot(R.col(1)) * R.col(1);
        return u.norm() / (1 + u.norm() / 7.5) * (along + Real(0.25) * (u - along));
    }
    const V3 across = u - u.dot(R.col(2)) * R.col(2);
    return across.norm() * across;
}
inline M3 air_damping(bough::Kind kind, const M3& R, const V3& u) {
    if (bough::is_flat(kind)) { // symmetric parts: of the drag from all sides, and along the normal
        const Real U = u.norm(), g = 1 / (1 + U / 7.5), along = u.dot(R.col(1));
        const M3 n = R.col(1) * R.col(1).transpose();
        return Real(0.25) * (g * U * M3::Identity() + g * g / U * u * u.transpose()) +
               Real(0.75) * (g * U + g * g / U * along * along) * n;
    }
    M3 D;
    for (int k = 0; k < 3; ++k)
        D.col(k) = first_derivative([&](Real s) { return air_force(kind, R, V3(u + s * V3::Unit(k))); });
    return D;
}

// [1/s] by which the air takes a leaf's own turning, times its inertia about the centre of mass; area: kappa rho A.
inline Real spin_rate(bough::Kind kind, Real area, Real mass, const V3& u) {
    return bough::is_flat(kind) ? 6 * area / mass * u.norm() / (1 + u.norm() / 7.5) : Real(0);
}

// [kg] First moments of kappa rho A about each joint of what it carries: a leaf counts outboard with its mean over all directions, to its own joint
// with its drag from all sides. Sets leaves where there are some.
inline std::vector<V3> drag_moments(const Problem& p, const Pose& pose, bool& leaves) {
    std::vector<Real> carried(p.tree.size_bodies());
    std::vector<V3> moment(p.tree.size_bodies(), V3::Zero());
    leaves = false;
    for (std::size_t i = p.tree.size_bodies(); i-- > 0;) {
        const bool flat = bough::is_flat(p.tree.kind[i]);
        leaves = leaves || flat;
        carried[i] += p.plan.drag_area[i] * (flat ? Real(0.5) : Real(1));
        moment[i] += p.plan.drag_area[i] * (flat ? Real(0.25) : Real(1)) * (pose.c[i] - pose.x[i]);
        if (p.tree.parent[i] < 0) continue;
        const auto q = std::size_t(p.tree.parent[i]);
        carried[q] += carried[i];
        moment[q] += carried[i] * (pose.x[i] - pose.x[q]);
    }
    return moment;
}
// [N m] What drag that pulls outward resists turning by.
inline M3 streaming(const V3& moment, const V3& u, bool leaves) {
    const V3 pull = u.norm() / (leaves ? 1 + u.norm() / 7.5 : Real(1)) * u;
    if (!(moment.dot(pull) > 0)) return M3::Zero();
    return moment.dot(pull) * (M3::Identity() - moment * moment.transpose() / moment.squaredNorm());
}

struct Solved {
    Matrix M; // [kg m^2] of the joints' rates, with what an implicit step adds
    Vector right;
    Vector rate_dot; // M^-1 right
};

inline Solved solve(const Problem& p) {
    const std::size_t n = p.tree.size_bodies();
    const Pose pose = pose_at(p, 0);
    const Vector v = first_derivative([&](Real s) { return centres(p, s); });
    const Vector a0 = second_derivative([&](Real s) { return centres(p, s); });
    std::vector<V3> omega(n), alpha0(n);
    bool leaves = false;
    const std::vector<V3> moments = p.air ? drag_moments(p, pose, leaves) : std::vector<V3>();
    Solved out{Matrix::Zero(3 * Eigen::Index(n), 3 * Eigen::Index(n)), Vector::Zero(3 * Eigen::Index(n)), {}};
    // A force at x and a moment on body i, as the joints of its path feel them.
    const auto push = [&](std::size_t i, const V3& x, const V3& force, const V3& moment) {
        for (std::int32_t k = std::int32_t(i); k >= 0; k = p.tree.parent[std::size_t(k)]) {
            const auto q = std::size_t(k);
            out.right.segment<3>(3 * k) += pose.R[q].transpose() * ((x - pose.x[q]).cross(force) + moment);
        }
    };
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Index at = 3 * Eigen::Index(i);
        const auto q = std::size_t(p.tree.parent[i]);
        const V3 own = pose.R[i] * p.rate[i].cast<Real>();
        omega[i] = (p.tree.parent[i] < 0 ? p.ground.omega : omega[q]) + own;
        alpha0[i] = (p.tree.parent[i] < 0 ? V3(V3::Zero()) : alpha0[q]) + omega[i].cross(own);
        const V3 vi = v.segment<3>(at), ai = a0.segment<3>(at);
        const M3& R = pose.R[i];
        const M3 I = R * p.tree.inertia[i].cast<Real>() * R.transpose();
        const Real m = p.tree.mass[i];
        M3 moved = m * M3::Identity(), turning = I; // mass and inertia, with what the air adds of them
        V3 force = m * (p.plan.scene.gravity.cast<Real>() - ai);
        V3 moment = -I * alpha0[i] - omega[i].cross(I * omega[i]);
        if (p.air) {
            const Real area = p.plan.drag_area[i];
            const V3 u = p.wind - vi;
            force += area * air_force(p.tree.kind[i], R, u);
            if (p.h > 0) {
                const M3 D = p.h * area * air_damping(p.tree.kind[i], R, u);
                moved += D;
                force -= D * ai;
            }
            const M3 spin = spin_rate(p.tree.kind[i], area, m, u) * I;
            turning += p.h * spin;
            moment -= spin * (omega[i] + p.h * alpha0[i]);
            if (p.h > 0 && !parts::carried_drag(p.plan).empty()) {
                const M3 W = streaming(moments[i], u, leaves);
                turning += p.h * p.h * W;
                moment -= p.h * W * (omega[i] + p.h * alpha0[i]);
            }
            if (p.h > 0 && bough::is_flat(p.tree.kind[i])) {
                const M3 W = Real(1.5) / (1 + u.norm() / 7.5) * area * Real(p.tree.com[i].norm()) * u.squaredNorm() *
                             R.col(0) * R.col(0).transpose();
                turning += p.h * p.h * W;
                moment -= p.h * W * (omega[i] + p.h * alpha0[i]);
            }
        }
        push(i, pose.c[i], force, moment);
        for (std::int32_t j = std::int32_t(i); j >= 0; j = p.tree.parent[std::size_t(j)])
            for (std::int32_t k = std::int32_t(i); k >= 0; k = p.tree.parent[std::size_t(k)]) {
                const M3 &Rj = pose.R[std::size_t(j)], &Rk = pose.R[std::size_t(k)];
                const M3 Jj = -cross(pose.c[i] - pose.x[std::size_t(j)]) * Rj;
                const M3 Jk = -cross(pose.c[i] - pose.x[std::size_t(k)]) * Rk;
                out.M.block<3, 3>(3 * j, 3 * k) += Jj.transpose() * moved * Jk + Rj.transpose() * turning * Rk;
            }
        M3 T;
        for (int k = 0; k < 3; ++k)
            T.col(k) = first_derivative(
                [&](Real s) { return logarithm(turned(p.theta[i].cast<Real>()) * turned(s * V3::Unit(k))); });
        const V3 K = p.tree.stiffness[i].cast<Real>() * Real(p.plan.scene.stiffness_scale);
        const Real beta = Real(p.tree.damping[i]) * Real(p.plan.scene.damping_scale);
        const V3 bent = p.theta[i].cast<Real>() + (p.h + beta) * (T * p.rate[i].cast<Real>());
        out.right.segment<3>(at) -= T.transpose() * K.cwiseProduct(bent);
        out.M.block<3, 3>(at, at) += p.h * (p.h + beta) * T.transpose() * K.asDiagonal() * T;
    }
    for (std::size_t k = 0; k < p.pulls.size(); ++k) {
        const auto& pull = p.plan.pulls[k];
        push(pull.body, pose.x[pull.body] + pose.R[pull.body] * pull.point_b.cast<Real>(), p.pulls[k], V3::Zero());
    }
    out.rate_dot = out.M.partialPivLu().solve(out.right);
    return out;
}

} // namespace dense
