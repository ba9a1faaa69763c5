#include "plan_bounds.h"
#include "../model/branch_mode.h"
#include "air.h"
#include "leaf_air.h"
#include "reduce.h"
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
template <class T> void plan_air_bounds(Plan<T>& plan, const Tree& tree, const std::vector<double>& weight) {
    const std::size_t n = plan.bodies;
    std::vector<std::uint8_t> depth(n, 0); // side branches left on the way from the root, at most those 16
    std::vector<double> sum(n), moved(n);  // over the path: of u, and what it moves the body's joint by
    for (auto* array : {&plan.sway, &plan.joint_distance, &plan.com_distance, &plan.inverse_weight}) array->reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool root = tree.parent[i] < 0;
        const auto p = std::size_t(tree.parent[i]);
        if (!root) depth[i] = std::uint8_t(std::min(depth[p] + (continues_parent(tree, i) ? 0 : 1), 16));
        const double u = std::ldexp(weight[i], depth[i]);
        const double r = root ? 0 : tree.joint_position[i].norm(), arm = air_arm(tree, i);
        sum[i] = u + (root ? 0 : sum[p]);
        moved[i] = root ? 0 : moved[p] + sum[p] * r;
        plan.sway.push_back(T(moved[i] + sum[i] * arm));
        plan.joint_distance.push_back(T(r));
        plan.com_distance.push_back(T(arm));
        plan.inverse_weight.push_back(T(1 / u));
    }
}

// P: the first moment that a body's own turning moves, body axes.
template <class T> std::vector<Vec3> own_moments(const Plan<T>& plan, const Tree& tree) {
    std::vector<Vec3> P(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) P[i] = tree.mass[i] * tree.com[i];
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (tree.parent[i] >= 0) P[std::size_t(tree.parent[i])] += double(plan.c_mass[i]) * tree.joint_position[i];
    return P;
}

} // namespace

template <class T> void plan_surfaces(Plan<T>& plan, const Tree& tree, const Scene& scene) {
    plan.drag_area.reserve(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i)
        plan.drag_area.push_back(
            T(drag_area(kind_in_air(tree, i), tree.size[i], scene.air_density, plate_kappa(scene))));
}

template <class T> std::vector<double> plan_modes(Plan<T>& plan, const Tree& tree) {
    BranchModes modes = branch_modes(tree);
    const bool scaled = plan.scene.joint_inertia == JointInertia::branch;
    plan.inertia_factor.reserve(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const double fb = scaled ? modes.factor_bend[i] : 1, ft = scaled ? modes.factor_twist[i] : 1;
        plan.inertia_factor.push_back(Vec3(std::sqrt(fb), std::sqrt(fb), std::sqrt(ft)).template cast<T>());
    }
    std::vector<double> weight = std::move(modes.weight);
    modes = {};
    if (plan.wind) plan_air_bounds(plan, tree, weight);
    return weight;
}

template <class T> void plan_gravity_rows(Plan<T>& plan, const Tree& tree, const std::vector<double>& weight) {
    const std::size_t n = plan.bodies;
    const double strength = plan.gravity ? plan.scene.gravity.norm() : 1;
    plan.row_gravity = plan.gravity ? plan.scene.gravity.template cast<T>().norm() : T(1);
    std::vector<double> plain(n), weighed(n); // weighed: at first the sum of u over the path
    for (std::size_t i = 0; i < n; ++i)
        weighed[i] = weight[i] + (tree.parent[i] < 0 ? 0 : weighed[std::size_t(tree.parent[i])]);
    {
        const std::vector<Vec3> P = own_moments(plan, tree);
        for (std::size_t i = 0; i < n; ++i) plain[i] = strength * P[i].norm();
    }
    for (std::size_t i = 0; i < n; ++i) weighed[i] *= plain[i];
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0) continue;
        plain[std::size_t(tree.parent[i])] += plain[i];
        weighed[std::size_t(tree.parent[i])] += weighed[i];
    }
    plan.gravity_row.reserve(n);
    for (std::size_t i = 0; i < n; ++i) plan.gravity_row.push_back(T(std::max(0.0, weighed[i] / weight[i] - plain[i])));
}

template <class T> void plan_carried_moments(Plan<T>& plan, const Tree& tree) {
    const std::vector<Vec3> P = own_moments(plan, tree);
    plan.carried_moment.reserve(plan.bodies);
    for (const Vec3& moment : P) plan.carried_moment.push_back(moment.template cast<T>());
}

template <class T> void plan_carried_drag(Plan<T>& plan, const Tree& tree) {
    std::vector<double> drag(plan.bodies); // [kg/m] of all outboard, its own included
    std::vector<Vec3> P(plan.bodies);
    for (std::size_t i = plan.bodies; i-- > 0;) {
        const bool flat = is_flat(kind_in_air(tree, i));
        drag[i] += double(plan.drag_area[i]) * (flat ? blade_mean : 1);
        P[i] = double(plan.drag_area[i]) * (flat ? streaming_drag : 1) * tree.com[i];
        if (tree.parent[i] >= 0) drag[std::size_t(tree.parent[i])] += drag[i];
    }
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (tree.parent[i] >= 0) P[std::size_t(tree.parent[i])] += drag[i] * tree.joint_position[i];
    plan.carried_drag.reserve(plan.bodies);
    for (const Vec3& moment : P) plan.carried_drag.push_back(moment.template cast<T>());
}

template void plan_carried_drag(Plan<float>&, const Tree&);
template void plan_carried_drag(Plan<double>&, const Tree&);
template void plan_surfaces(Plan<float>&, const Tree&, const Scene&);
template std::vector<double> plan_modes(Plan<float>&, const Tree&);
template void plan_gravity_rows(Plan<float>&, const Tree&, const std::vector<double>&);
template void plan_carried_moments(Plan<float>&, const Tree&);
template void plan_surfaces(Plan<double>&, const Tree&, const Scene&);
template std::vector<double> plan_modes(Plan<double>&, const Tree&);
template void plan_gravity_rows(Plan<double>&, const Tree&, const std::vector<double>&);
template void plan_carried_moments(Plan<double>&, const Tree&);

} // namespace bough
