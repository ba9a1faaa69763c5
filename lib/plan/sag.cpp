#include "sag.h"
#include "../base/cholesky.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace bough {

Mat3 frame_of(const Tree& tree, const std::vector<Quat>& rest, std::size_t i, const std::vector<Mat3>& R,
              const Vec3& theta) {
    const std::int32_t p = tree.parent[i];
    const Mat3 R_pj = rest[i].toRotationMatrix();
    return (p < 0 ? R_pj : Mat3(R[std::size_t(p)] * R_pj)) * rotation_from_vector(theta);
}

std::vector<Vec3> turned_moments(const Tree& tree, std::vector<double> mass, const std::vector<Mat3>& R) {
    const std::size_t n = tree.size_bodies();
    std::vector<Vec3> P(n);
    for (std::size_t i = 0; i < n; ++i) P[i] = mass[i] * (R[i] * tree.com[i]);
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0) continue;
        const auto p = std::size_t(tree.parent[i]);
        const Vec3 arm = R[p] * tree.joint_position[i];
        P[p] += mass[i] * arm;
        mass[p] += mass[i];
    }
    return P;
}

std::vector<Vec3> gravity_moments(const Tree& tree, std::vector<Vec3> P, const Vec3& gravity) {
    std::vector<Vec3>& tau = P;
    for (Vec3& moment : tau) moment = moment.cross(gravity).eval();
    for (std::size_t i = tau.size(); i-- > 0;)
        if (tree.parent[i] >= 0) tau[std::size_t(tree.parent[i])] += tau[i];
    return P;
}

namespace {

// One Newton step for the sag; returns the first body whose elimination block is not positive definite, or -1. lift: such blocks are made so, by a
// multiple of 1 on them: the step then goes downhill in energy.
std::int64_t newton_step(const Tree& tree, const Vec3& gravity, const StartPose& pose, std::vector<Vec3>& change,
                         bool lift = false) {
    const std::vector<Vec3>& theta = pose.theta;
    const std::size_t n = tree.size_bodies();
    std::vector<Mat3> R(n);
    for (std::size_t i = 0; i < n; ++i) R[i] = frame_of(tree, pose.joint_rotation, i, R, theta[i]);
    const std::vector<Vec3> P = turned_moments(tree, tree.mass, R);
    const std::vector<Vec3> tau = gravity_moments(tree, P, gravity);
    std::vector<Mat3> A(n), E(n);
    std::vector<Vec3> u(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Mat3 pg = P[i] * gravity.transpose();
        A[i] = P[i].dot(gravity) * Mat3::Identity() - (pg + pg.transpose()) / 2;
        u[i] = Vec3::Zero();
    }
    std::int64_t soft = -1;
    for (std::size_t i = n; i-- > 0;) {
        const Mat3 rates = body_rate_jacobian_inverse(theta[i]) * R[i].transpose(); // of theta, from world
        const Mat3 Z = rates.transpose() * tree.stiffness[i].asDiagonal() * rates;
        Mat3 sum = Z + A[i];
        if (!Cholesky<double>(sum).positive) {
            soft = std::int64_t(i);
            if (lift) {
                const double least = Eigen::SelfAdjointEigenSolver<Mat3>(sum, Eigen::EigenvaluesOnly).eigenvalues()[0];
                A[i].diagonal().array() += 1e-3 * Z.trace() - 1.5 * std::min(least, 0.0);
                sum = Z + A[i];
            }
        }
        E[i] = sum.inverse();
        // What this joint's own spring leaves unbalanced; what hangs further out has been added by its own joints.
        const Vec3 spring_b =
            body_rate_jacobian_inverse(theta[i]).transpose() * tree.stiffness[i].cwiseProduct(theta[i]);
        const Vec3 residual = tau[i] - R[i] * spring_b;
        u[i] += residual;
        if (tree.parent[i] < 0) continue;
        const auto p = std::size_t(tree.parent[i]);
        const Mat3 passed = Z * E[i] * A[i];
        A[p] += (passed + passed.transpose()) / 2;
        u[p] += Z * E[i] * u[i] - residual;
    }
    std::vector<Vec3> psi(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 base = tree.parent[i] < 0 ? Vec3(Vec3::Zero()) : psi[std::size_t(tree.parent[i])];
        const Vec3 turn = E[i] * (u[i] - A[i] * base);
        psi[i] = base + turn;
        change[i] = body_rate_jacobian_inverse(theta[i]) * (R[i].transpose() * turn);
    }
    return soft;
}

// [J] elastic, and of gravity.
double energy_of(const Tree& tree, const Vec3& gravity, const StartPose& pose) {
    const std::size_t n = tree.size_bodies();
    std::vector<Mat3> R(n);
    std::vector<Vec3> x(n);
    double energy = 0;
    for (std::size_t i = 0; i < n; ++i) {
        R[i] = frame_of(tree, pose.joint_rotation, i, R, pose.theta[i]);
        const auto p = std::size_t(tree.parent[i]);
        x[i] = tree.parent[i] < 0 ? tree.joint_position[i] : Vec3(x[p] + R[p] * tree.joint_position[i]);
        energy += pose.theta[i].dot(tree.stiffness[i].cwiseProduct(pose.theta[i])) / 2;
        energy -= tree.mass[i] * gravity.dot(x[i] + R[i] * tree.com[i]);
    }
    return energy;
}

} // namespace

std::optional<NoPose> settle(const Tree& tree, const Vec3& gravity, StartPose& pose, int iterations) {
    const std::size_t n = tree.size_bodies();
    std::vector<Vec3> change(n);
    std::size_t worst = 0;
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < iterations; ++iteration) {
        const std::int64_t soft = newton_step(tree, gravity, pose, change);
        double largest = 0, angle = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double size = change[i].norm();
            if (!(size <= largest)) largest = size, worst = i;
            angle = std::max(angle, pose.theta[i].norm());
        }
        if (!std::isfinite(largest)) break;
        // Rounding stops the change from shrinking: converged as far as doubles go.
        const bool converged = largest <= 1e-14 || (largest <= 1e-11 * (1 + angle) && largest >= previous / 2);
        if (converged && soft < 0) return std::nullopt;
        if (converged)
            return NoPose{std::size_t(soft), " buckles under its own weight: there is no stable settled pose"};
        previous = largest;
        const double scale = std::min(1.0, 0.5 / largest); // no joint turns by more than half a radian an iteration
        for (std::size_t i = 0; i < n; ++i) pose.theta[i] += scale * change[i];
    }
    return NoPose{worst, " does not come to rest under its own weight: no settled pose found"};
}

void descend(const Tree& tree, const Vec3& gravity, StartPose& pose) {
    std::vector<Vec3> change(tree.size_bodies());
    double energy = energy_of(tree, gravity, pose);
    for (int iteration = 0; iteration < 2000; ++iteration) {
        const std::int64_t soft = newton_step(tree, gravity, pose, change, true);
        double largest = 0;
        for (const Vec3& turn : change) largest = std::max(largest, turn.norm());
        if (!std::isfinite(largest) || (largest < 1e-5 && soft < 0)) return;
        double scale = std::min(1.0, 0.5 / largest);
        for (; scale > 1e-9; scale /= 2) {
            StartPose next = pose;
            for (std::size_t i = 0; i < change.size(); ++i) next.theta[i] += scale * change[i];
            const double lower = energy_of(tree, gravity, next);
            if (!(lower < energy)) continue;
            pose = std::move(next);
            energy = lower;
            break;
        }
        if (!(scale > 1e-9)) return; // as low as rounding lets it come
    }
}

} // namespace bough
