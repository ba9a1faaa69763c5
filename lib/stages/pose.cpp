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

// World from body, turned by theta from the springs' rest.
Mat3 frame_of(const Tree& tree, const std::vector<Quat>& rest, std::size_t i, const std::vector<Mat3>& R,
              const Vec3& theta) {
    const std::int32_t p = tree.parent[i];
    const Mat3 R_pj = rest[i].toRotationMatrix();
    return (p < 0 ? R_pj : Mat3(R[std::size_t(p)] * R_pj)) * rotation_from_vector(theta);
}

// First moment that body i's own turning moves, P of coupled gravity: its mass and its children's composites at their joints. World.
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

// Moments of gravity about each joint on its composite, world; in P's place.
std::vector<Vec3> gravity_moments(const Tree& tree, std::vector<Vec3> P, const Vec3& gravity) {
    std::vector<Vec3>& tau = P;
    for (Vec3& moment : tau) moment = moment.cross(gravity).eval();
    for (std::size_t i = tau.size(); i-- > 0;)
        if (tree.parent[i] >= 0) tau[std::size_t(tree.parent[i])] += tau[i];
    return P;
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

StartPose unturned(const Tree& tree) {
    return {tree.joint_rotation, std::vector<Vec3>(tree.size_bodies(), Vec3::Zero())};
}

// What the drawn tree carries in its equilibrium.
std::vector<double> unloaded_mass(const Tree& tree) {
    std::vector<double> mass(tree.mass);
    for (std::size_t i = 0; i < tree.load.size(); ++i) mass[i] -= tree.load[i];
    return mass;
}

StartPose drawn(const Tree& tree, const Vec3& gravity) {
    if (gravity.isZero()) return unturned(tree);
    const std::size_t n = tree.size_bodies();
    std::vector<Mat3> R(n);
    for (std::size_t i = 0; i < n; ++i) R[i] = frame_of(tree, tree.joint_rotation, i, R, Vec3::Zero());
    // Moments, until each is carried.
    StartPose pose{{}, gravity_moments(tree, turned_moments(tree, unloaded_mass(tree), R), gravity)};
    pose.joint_rotation.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 tau_b = R[i].transpose() * pose.theta[i];
        pose.theta[i] = carry(tree, i, tau_b);
        if (!(pose.theta[i].norm() <= 3.14159265358979323846)) // the step would take it the other way round (spring.h)
            throw std::domain_error(name_of(tree, i) + " is too soft to carry its weight in the drawn pose: its spring "
                                                       "would be wound by more than half a turn");
        pose.joint_rotation[i] =
            (tree.joint_rotation[i] * quaternion_from_vector<double>(pose.theta[i]).conjugate()).normalized();
    }
    return pose;
}

// One Newton step for the sag; returns the first body whose elimination block is not positive definite, or -1.
std::int64_t newton_step(const Tree& tree, const Vec3& gravity, const StartPose& pose, std::vector<Vec3>& change) {
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
        const Mat3 sum = Z + A[i];
        if (sum.llt().info() != Eigen::Success) soft = std::int64_t(i);
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

// The sag of springs at this rest, found from these angles on.
StartPose settled(const Tree& tree, const Vec3& gravity, StartPose pose) {
    const std::size_t n = tree.size_bodies();
    if (gravity.isZero()) return pose;
    std::vector<Vec3> change(n);
    std::size_t worst = 0;
    double previous = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 500; ++iteration) {
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
        return tree.load.empty() ? drawn(tree, gravity) : settled(tree, gravity, drawn(tree, gravity));
    case Pose::settled:
        return settled(tree, gravity, unturned(tree));
    case Pose::rest:
        break;
    }
    return unturned(tree);
}

} // namespace bough
