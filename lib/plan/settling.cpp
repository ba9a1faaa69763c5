#include "settling.h"
#include "../laws/wind_field.h"
#include "body_air.h"
#include "pose.h"
#include "sag.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bough {
namespace {

constexpr double forgotten = 4.605; // ln 100

// Of a tree's bodies what sag.h reads, scaled by the scene.
Tree standing(const Tree& tree, const TreeRange& range, const Scene& scene) {
    Tree own;
    const auto take = [&](auto& to, const auto& from) {
        if (from.empty()) return;
        const auto first = from.begin() + std::ptrdiff_t(range.first_body);
        to.assign(first, first + std::ptrdiff_t(range.bodies));
    };
    take(own.parent, tree.parent);
    take(own.mass, tree.mass);
    take(own.com, tree.com);
    take(own.joint_position, tree.joint_position);
    take(own.joint_rotation, tree.joint_rotation);
    take(own.stiffness, tree.stiffness);
    take(own.branch, tree.branch);
    take(own.load, tree.load);
    for (std::int32_t& parent : own.parent)
        if (parent >= 0) parent -= std::int32_t(range.first_body);
    for (Vec3& K : own.stiffness) K *= scene.stiffness_scale;
    return own;
}

struct Standing {
    std::vector<Mat3> R;   // world from body
    std::vector<Vec3> com; // [m] world
};
Standing stand(const Tree& tree, const StartPose& pose) {
    const std::size_t n = tree.size_bodies();
    Standing there{std::vector<Mat3>(n), std::vector<Vec3>(n)};
    std::vector<Vec3> x(n);
    for (std::size_t i = 0; i < n; ++i) {
        there.R[i] = frame_of(tree, pose.joint_rotation, i, there.R, pose.theta[i]);
        const auto p = std::size_t(tree.parent[i]);
        x[i] = tree.parent[i] < 0 ? tree.joint_position[i] : Vec3(x[p] + there.R[p] * tree.joint_position[i]);
        there.com[i] = x[i] + there.R[i] * tree.com[i];
    }
    return there;
}

} // namespace

FirstSway first_sway(const Tree& tree, const TreeRange& range, const Scene& scene) {
    const Tree own = standing(tree, range, scene);
    Vec3 along = scene.wind ? scene.wind->velocity : Vec3(Vec3::Zero());
    const double weight = scene.gravity.norm() > 0 ? scene.gravity.norm() : 10;
    if (scene.gravity.norm() > 0) along -= along.dot(scene.gravity) / scene.gravity.squaredNorm() * scene.gravity;
    const Vec3 e = along.norm() > 0 ? Vec3(along.normalized()) : Vec3(Vec3::UnitX());
    const double a = 1e-3 * weight;
    StartPose start, bent;
    try {
        start = bent = start_pose(own, scene.gravity, scene.pose);
    } catch (const std::domain_error&) { // the plan will say so
        return {};
    }
    // The tilt is so slight that one step of Newton's is the bend, to a thousandth; what does not converge, as soft stalks turned far, bends so too.
    [[maybe_unused]] const auto unfinished = settle(own, scene.gravity + a * e, bent, 1);
    const Standing before = stand(own, start), after = stand(own, bent);
    double pushed = 0, moved = 0, lost = 0;
    for (std::size_t i = 0; i < own.size_bodies(); ++i) {
        const std::size_t whole = range.first_body + i;
        const Vec3 u = after.com[i] - before.com[i], theta = bent.theta[i] - start.theta[i];
        pushed += own.mass[i] * u.dot(e);
        moved += own.mass[i] * u.squaredNorm();
        lost += scene.damping_scale * tree.damping[whole] * theta.dot(own.stiffness[i].cwiseProduct(theta));
        if (!scene.wind) continue;
        const AirBody<double> mean = streaming(air_body(tree, whole, scene), leaf_proportion(tree, whole), before.R[i]);
        const Mat3 D =
            air_damping(mean.kind, before.R[i], mean_wind(*scene.wind, before.com[i]), mean.facing, mean.normal);
        lost += mean.drag_area * u.dot(D * u);
    }
    if (!(pushed > 0) || !(moved > 0) || !std::isfinite(moved)) return {}; // it buckles
    const double omega = std::sqrt(a * pushed / moved);
    return {omega, lost / (2 * omega * moved)};
}

double settling_time(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene& scene) {
    if (!scene.wind || !blows(*scene.wind)) return 0;
    double longest = least_settling;
    for (const TreeRange& range : ranges) {
        if (range.bodies == 0) continue;
        const FirstSway sway = first_sway(tree, range, scene);
        const double over = std::max(sway.zeta * sway.zeta - 1, 0.0);
        const double rate = sway.omega * (sway.zeta - std::sqrt(over));
        longest = std::max(longest, rate > 0 ? forgotten / rate : most_settling);
    }
    return std::min(longest, most_settling);
}

} // namespace bough
