#include "pose.h"
#include "../base/parallel.h"
#include "../base/shortest_text.h"
#include "sag.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace bough {
namespace {

// How much thicker wood would carry its moment: stiffness goes with the fourth power.
std::string what_would_carry(const Tree& tree, std::size_t i, const Vec3& tau) {
    constexpr double sag = 0.5; // [rad]
    const double K = tree.stiffness[i].minCoeff();
    const auto digits = [](double value) { return rounded_text(value, 3); };
    const std::string bears = "it bears " + digits(tau.norm()) + " N m on a spring of " + digits(K) + " N m/rad; ";
    if (i < tree.kind.size() && tree.kind[i] != Kind::branch) // of what only settles the kind is not known
        return bears + "a stiffer one would carry it: leaf_modulus of a --material FILE";
    return bears + "wood " + digits(std::pow(std::max(1.0, tau.norm() / (sag * K)), 0.25)) +
           " times as thick would carry it: treeconvert --radii carry makes it so" +
           (tree.parent[i] < 0 ? ", or, where --root-stiffness was given, a stiffer root" : "");
}

// theta with K theta = J^T tau, the moment given in the body's frame, J the body rates' Jacobian at theta. The slope of
// J^T tau is left out of Newton's matrix but for its first term: what remains is small and converges in a few rounds.
Vec3 carry(const Tree& tree, std::size_t i, const Vec3& tau) {
    const Vec3& K = tree.stiffness[i];
    for (int a = 0; a < 3; ++a)
        if (K[a] == 0 && tau.norm() > 0)
            throw NoPose{i, " has a free axis (K = 0) and cannot carry its weight in the drawn pose: start it with "
                            "pose rest or settled"};
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
        throw NoPose{i, " is too soft to carry its weight in the drawn pose: " + what_would_carry(tree, i, tau)};
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
    parallel_for(n, 300, [&](std::size_t i) {
        const Vec3 tau_b = R[i].transpose() * pose.theta[i];
        pose.theta[i] = carry(tree, i, tau_b);
        if (!(pose.theta[i].norm() <= 3.14159265358979323846)) // the step would take it the other way round (spring.h)
            throw NoPose{i, " is too soft to carry its weight in the drawn pose, its spring wound by more than half a "
                            "turn: " +
                                what_would_carry(tree, i, tau_b)};
        pose.joint_rotation[i] =
            (tree.joint_rotation[i] * quaternion_from_vector<double>(pose.theta[i]).conjugate()).normalized();
    });
    return pose;
}

StartPose settled(const Tree& tree, const Vec3& gravity) {
    StartPose pose = unturned(tree);
    if (const auto wrong = settle(tree, gravity, pose)) throw *wrong;
    return pose;
}

// From the drawn pose. What buckles under its load goes over: then downhill, and with time, as next to buckling the Newton steps, whose matrix
// leaves out how T turns with theta, shrink by a few percent each.
StartPose loaded(const Tree& tree, const Vec3& gravity) {
    const StartPose start = drawn(tree, gravity);
    StartPose pose = start;
    if (!settle(tree, gravity, pose)) return pose;
    pose = start;
    descend(tree, gravity, pose);
    if (const auto wrong = settle(tree, gravity, pose, 5000)) throw *wrong;
    return pose;
}

// The trees of several roots, each by itself with what settle() reads, and which bodies they are of.
struct RootTree {
    Tree tree;
    std::vector<std::size_t> body;
};

std::vector<RootTree> each_root_of(const Tree& tree) {
    std::vector<RootTree> trees;
    std::vector<std::size_t> root(tree.size_bodies());   // which of them a body is of
    std::vector<std::int32_t> place(tree.size_bodies()); // its index there
    for (std::size_t i = 0; i < root.size(); ++i) {
        const bool is_root = tree.parent[i] < 0;
        const auto p = std::size_t(is_root ? 0 : tree.parent[i]);
        if (is_root) trees.emplace_back();
        root[i] = is_root ? trees.size() - 1 : root[p];
        RootTree& own = trees[root[i]];
        place[i] = std::int32_t(own.body.size());
        own.body.push_back(i);
        own.tree.parent.push_back(is_root ? -1 : place[p]);
        if (!tree.kind.empty()) own.tree.kind.push_back(tree.kind[i]);
        own.tree.mass.push_back(tree.mass[i]);
        own.tree.com.push_back(tree.com[i]);
        own.tree.joint_position.push_back(tree.joint_position[i]);
        own.tree.joint_rotation.push_back(tree.joint_rotation[i]);
        own.tree.stiffness.push_back(tree.stiffness[i]);
        if (!tree.load.empty()) own.tree.load.push_back(tree.load[i]);
    }
    return trees;
}

// What is found by iteration, each root's tree by itself: how many steps one takes is no other's matter, so that a tree of a park starts as
// it does alone.
StartPose each_root(const Tree& tree, const Vec3& gravity, StartPose (*find)(const Tree&, const Vec3&)) {
    if (std::count_if(tree.parent.begin(), tree.parent.end(), [](std::int32_t p) { return p < 0; }) == 1)
        return find(tree, gravity);
    StartPose whole = unturned(tree);
    for (const RootTree& part : each_root_of(tree)) {
        StartPose own;
        try {
            own = find(part.tree, gravity);
        } catch (NoPose& wrong) {
            wrong.body = part.body[wrong.body];
            throw;
        }
        for (std::size_t i = 0; i < part.body.size(); ++i) {
            whole.joint_rotation[part.body[i]] = own.joint_rotation[i];
            whole.theta[part.body[i]] = own.theta[i];
        }
    }
    return whole;
}

StartPose found(const Tree& tree, const Vec3& gravity, Pose pose) {
    switch (pose) {
    case Pose::drawn:
        return gravity.isZero() || tree.load.empty() ? drawn(tree, gravity) : each_root(tree, gravity, loaded);
    case Pose::settled:
        return gravity.isZero() ? unturned(tree) : each_root(tree, gravity, settled);
    case Pose::rest:
        break;
    }
    return unturned(tree);
}

} // namespace

StartPose start_pose(const Tree& tree, const Vec3& gravity, Pose pose) {
    try {
        return found(tree, gravity, pose);
    } catch (const NoPose& wrong) {
        const bool under_load = pose == Pose::drawn && !tree.load.empty();
        throw NoStart(wrong.body, tree.branch[wrong.body], (under_load ? " under its load" : "") + wrong.why);
    }
}

NoStart::NoStart(std::size_t of, std::int32_t on, const std::string& wrong)
    : std::domain_error("body " + std::to_string(of) + " of branch " + std::to_string(on) + wrong), body(of),
      branch(on), why(wrong) {}

} // namespace bough
