#include "analytic_constants.h"
#include "../laws/leaf_air.h"
#include "../model/branch_mode.h"
#include "../plan/carried.h"
#include "../plan/reduced.h"
#include "fictitious.h"
#include <algorithm>

namespace bough {
namespace {

// [m] What turns with a body is within this of its joint (drag.h): its centre of mass, and of a leaf or clump, whose turning the air damps, its
// inertia too, which is then at most its mass times the rest of this (external_forces.cpp).
double air_arm(const Tree& tree, std::size_t i) {
    if (!is_foliage(kind_in_air(tree, i))) return tree.com[i].norm();
    return std::sqrt(tree.com[i].squaredNorm() + tree.inertia[i].trace() / (2 * tree.mass[i]));
}

// Drag's bounds. A side branch's weight is twice its parent's again (drag.h), up to 2^16.
template <class T> void air_bounds(const Tree& tree, const std::vector<double>& weight, AnalyticPlan<T>& own) {
    const std::size_t n = tree.size_bodies();
    std::vector<std::uint8_t> depth(n, 0); // side branches left on the way from the root, at most those 16
    std::vector<double> sum(n), moved(n);  // over the path: of u, and what it moves the body's joint by
    for (auto* array : {&own.sway, &own.joint_distance, &own.com_distance, &own.inverse_weight}) array->reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool root = tree.parent[i] < 0;
        const auto p = std::size_t(tree.parent[i]);
        if (!root) depth[i] = std::uint8_t(std::min(depth[p] + (continues_parent(tree, i) ? 0 : 1), 16));
        const double u = std::ldexp(weight[i], depth[i]);
        const double r = root ? 0 : tree.joint_position[i].norm(), arm = air_arm(tree, i);
        sum[i] = u + (root ? 0 : sum[p]);
        moved[i] = root ? 0 : moved[p] + sum[p] * r;
        own.sway.push_back(T(moved[i] + sum[i] * arm));
        own.joint_distance.push_back(T(r));
        own.com_distance.push_back(T(arm));
        own.inverse_weight.push_back(T(1 / u));
    }
}

// Factors of inertia, and with a wind the bounds of its drag. Returns the weights by which gravity and drag are summed along a path.
template <class T> std::vector<double> take_modes(const Plan<T>& plan, const Tree& tree, AnalyticPlan<T>& own) {
    BranchModes modes = branch_modes(tree);
    const bool scaled = plan.scene.joint_inertia == JointInertia::branch;
    own.inertia_factor.reserve(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const double fb = scaled ? modes.factor_bend[i] : 1, ft = scaled ? modes.factor_twist[i] : 1;
        own.inertia_factor.push_back(Vec3(std::sqrt(fb), std::sqrt(fb), std::sqrt(ft)).template cast<T>());
    }
    std::vector<double> weight = std::move(modes.weight);
    modes = {};
    if (plan.wind) air_bounds(tree, weight, own);
    return weight;
}

// Sums over the subtree of |g| |P|, plain and times the path's u.
template <class T>
void take_gravity_rows(const Plan<T>& plan, const Tree& tree, const std::vector<double>& weight, AnalyticPlan<T>& own) {
    const std::size_t n = plan.bodies;
    const double strength = plan.gravity ? plan.scene.gravity.norm() : 1;
    own.row_gravity = plan.gravity ? plan.scene.gravity.template cast<T>().norm() : T(1);
    std::vector<double> plain(n), weighed(n); // weighed: at first the sum of u over the path
    for (std::size_t i = 0; i < n; ++i)
        weighed[i] = weight[i] + (tree.parent[i] < 0 ? 0 : weighed[std::size_t(tree.parent[i])]);
    {
        const std::vector<Vec3> P = carried_moments(plan, tree);
        for (std::size_t i = 0; i < n; ++i) plain[i] = strength * P[i].norm();
    }
    for (std::size_t i = 0; i < n; ++i) weighed[i] *= plain[i];
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0) continue;
        plain[std::size_t(tree.parent[i])] += plain[i];
        weighed[std::size_t(tree.parent[i])] += weighed[i];
    }
    own.gravity_row.reserve(n);
    for (std::size_t i = 0; i < n; ++i) own.gravity_row.push_back(T(std::max(0.0, weighed[i] / weight[i] - plain[i])));
}

} // namespace

template <class T> void take_analytic_constants(const Plan<T>& plan, const Tree& tree, AnalyticPlan<T>& own) {
    own.fictitious = plan.scene.fictitious && lags(*plan.scene.fictitious);
    const std::vector<double> weight = take_modes(plan, tree, own);
    if (plan.gravity || plan.root_motion) take_gravity_rows(plan, tree, weight, own);
}

#define BOUGH_INSTANTIATE(T) template void take_analytic_constants(const Plan<T>&, const Tree&, AnalyticPlan<T>&);
#include "../base/instantiate.inc"

} // namespace bough
