#include "pose.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <string>

namespace bough {
namespace {

std::string name_of(const Tree& tree, std::size_t i) {
    return "body " + std::to_string(i) + " of branch " + std::to_string(tree.branch[i]);
}

struct Frames {
    std::vector<Mat3> R; // world from body
    std::vector<Vec3> r; // [m] own joint as seen from the parent's joint (zero for roots), world
};

Frames frames(const Tree& tree, const std::vector<Vec3>& theta) {
    const std::size_t n = tree.size_bodies();
    Frames f{std::vector<Mat3>(n), std::vector<Vec3>(n, Vec3::Zero())};
    for (std::size_t i = 0; i < n; ++i) {
        Mat3 R_wj = tree.joint_rotation[i].toRotationMatrix();
        if (tree.parent[i] >= 0) {
            const auto p = std::size_t(tree.parent[i]);
            R_wj = f.R[p] * R_wj;
            f.r[i] = f.R[p] * tree.joint_position[i];
        }
        f.R[i] = R_wj * rotation_from_vector(theta[i]);
    }
    return f;
}

// First moment that body i's own turning moves, P of coupled gravity: its mass and its children's composites at their joints.
std::vector<Vec3> turned_moments(const Tree& tree, const Frames& f) {
    const std::size_t n = tree.size_bodies();
    std::vector<double> mass(tree.mass);
    std::vector<Vec3> P(n);
    for (std::size_t i = 0; i < n; ++i) P[i] = tree.mass[i] * (f.R[i] * tree.com[i]);
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0) continue;
        const auto p = std::size_t(tree.parent[i]);
        P[p] += mass[i] * f.r[i];
        mass[p] += mass[i];
    }
    return P;
}

// Moments of gravity about each joint on its composite, world.
std::vector<Vec3> gravity_moments(const Tree& tree, const std::vector<Vec3>& P, const Vec3& gravity) {
    std::vector<Vec3> tau(tree.size_bodies());
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i] = P[i].cross(gravity);
    for (std::size_t i = tau.size(); i-- > 0;)
        if (tree.parent[i] >= 0) tau[std::size_t(tree.parent[i])] += tau[i];
    return tau;
}

// theta with K theta = J^T tau, the moment given in the body's frame, J the body rates' Jacobian at theta. The slope of
// J^T tau is left out of Newton's matrix but for its first term: what remains is small and converges in a few rounds.
Vec3 carry(const Tree& tree, std::size_t i, const Vec3& tau) {
    const Vec3& K = tree.stiffness[i];
    for (int a = 0; a < 3; ++a)
        if (K[a] == 0 && tau.norm() > 0)
            throw std::domain_error(name_of(tree, i) +
                                    " has a free axis (K = 0) and cannot carry its weight in the drawn "
                                    "pose: start it with pose rest or settled");
    if (tau.norm() == 0) return Vec3::Zero();
    Vec3 theta = tau.cwiseQuotient(K);
    for (int iteration = 0; iteration < 100; ++iteration) {
        const Vec3 turned = body_rate_jacobian(theta).transpose() * tau;
        const Vec3 residual = turned - K.cwiseProduct(theta);
        const Mat3 slope = Mat3(K.asDiagonal()) + 0.5 * cross_matrix(turned);
        const Vec3 change = slope.partialPivLu().solve(residual);
        theta += change;
        if (change.norm() <= 1e-15 * theta.norm()) return theta;
    }
    // Rounding can keep the last digit moving; what is left must be rounding.
    const Vec3 left = body_rate_jacobian(theta).transpose() * tau - K.cwiseProduct(theta);
    if (left.norm() > 1e-12 * tau.norm())
        throw std::domain_error(name_of(tree, i) + " is too soft to carry its weight in the drawn pose");
    return theta;
}

StartPose drawn(const Tree& tree, const Vec3& gravity) {
    StartPose pose{tree.joint_rotation, std::vector<Vec3>(tree.size_bodies(), Vec3::Zero())};
    if (gravity.isZero()) return pose;
    const Frames f = frames(tree, pose.theta);
    const std::vector<Vec3> tau = gravity_moments(tree, turned_moments(tree, f), gravity);
    for (std::size_t i = 0; i < tau.size(); ++i) {
        pose.theta[i] = carry(tree, i, f.R[i].transpose() * tau[i]);
        if (!(pose.theta[i].norm() <= 3.14159265358979323846)) // the step would take it the other way round (spring.h)
            throw std::domain_error(name_of(tree, i) + " is too soft to carry its weight in the drawn pose: its spring "
                                                       "would be wound by more than half a turn");
        pose.joint_rotation[i] =
            (tree.joint_rotation[i] * quaternion_from_vector<double>(pose.theta[i]).conjugate()).normalized();
    }
    return pose;
}

// One Newton step for the sag; returns the first body whose elimination block is not positive definite, or -1.
std::int64_t newton_step(const Tree& tree, const Vec3& gravity, const std::vector<Vec3>& theta,
                         std::vector<Vec3>& change) {
    const std::size_t n = tree.size_bodies();
    const Frames f = frames(tree, theta);
    const std::vector<Vec3> P = turned_moments(tree, f);
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
        const Mat3 rates = body_rate_jacobian_inverse(theta[i]) * f.R[i].transpose(); // of theta, from world
        const Mat3 Z = rates.transpose() * tree.stiffness[i].asDiagonal() * rates;
        const Mat3 sum = Z + A[i];
        if (sum.llt().info() != Eigen::Success) soft = std::int64_t(i);
        E[i] = sum.inverse();
        // What this joint's own spring leaves unbalanced; what hangs further out has been added by its own joints.
        const Vec3 spring_b =
            body_rate_jacobian_inverse(theta[i]).transpose() * tree.stiffness[i].cwiseProduct(theta[i]);
        const Vec3 residual = tau[i] - f.R[i] * spring_b;
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
        change[i] = body_rate_jacobian_inverse(theta[i]) * (f.R[i].transpose() * turn);
    }
    return soft;
}

StartPose settled(const Tree& tree, const Vec3& gravity) {
    const std::size_t n = tree.size_bodies();
    StartPose pose{tree.joint_rotation, std::vector<Vec3>(n, Vec3::Zero())};
    if (gravity.isZero()) return pose;
    std::vector<Vec3> change(n);
    std::size_t worst = 0;
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 500; ++iteration) {
        const std::int64_t soft = newton_step(tree, gravity, pose.theta, change);
        double largest = 0, angle = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double size = change[i].norm();
            if (!(size <= largest)) largest = size, worst = i;
            angle = std::max(angle, pose.theta[i].norm());
        }
        if (!std::isfinite(largest)) break;
        // Rounding stops the change from shrinking: converged as far as doubles go.
        const bool converged = largest <= 1e-14 || (largest <= 1e-11 * (1 + angle) && largest >= previous / 2);
        if (converged) {
            if (soft >= 0)
                throw std::domain_error(name_of(tree, std::size_t(soft)) +
                                        " buckles under its own weight: there is no stable settled pose");
            return pose;
        }
        previous = largest;
        const double scale = std::min(1.0, 0.5 / largest); // no joint turns by more than half a radian an iteration
        for (std::size_t i = 0; i < n; ++i) pose.theta[i] += scale * change[i];
    }
    throw std::domain_error(name_of(tree, worst) +
                            " does not come to rest under its own weight: no settled pose found");
}

} // namespace

StartPose start_pose(const Tree& tree, const Vec3& gravity, Pose pose) {
    switch (pose) {
    case Pose::drawn:
        return drawn(tree, gravity);
    case Pose::settled:
        return settled(tree, gravity);
    case Pose::rest:
        break;
    }
    return {tree.joint_rotation, std::vector<Vec3>(tree.size_bodies(), Vec3::Zero())};
}

} // namespace bough
