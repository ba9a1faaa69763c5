#include "drawn_pose.h"
#include "scene.h"
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace bough {

namespace {

const TreeRange& range_of(const std::vector<TreeRange>& trees, std::int32_t tree) {
    if (tree < 0 || std::size_t(tree) >= trees.size())
        throw std::out_of_range("tree " + std::to_string(tree) + ", but there are " + std::to_string(trees.size()) +
                                " trees (0 is the first)");
    return trees[std::size_t(tree)];
}

Selected by_body(const Tree& joined, const TreeRange& range, const Selector& selector) {
    if (selector.body < 0 || std::size_t(selector.body) >= range.bodies)
        throw std::out_of_range("body " + std::to_string(selector.body) + ", but tree " +
                                std::to_string(selector.tree) + " has " + std::to_string(range.bodies) +
                                " bodies (0 is the first)");
    const std::size_t i = range.first_body + std::size_t(selector.body);
    return {i, selector.point.value_or(joined.com[i])};
}

// The piece that holds `at` is the last one that begins there or before; it ends where the next one begins.
Selected by_branch(const Tree& joined, const TreeRange& range, const Selector& selector) {
    const std::int32_t branch = range.first_branch + selector.branch;
    const std::size_t end = range.first_body + range.bodies;
    std::size_t piece = end;
    double next = std::numeric_limits<double>::infinity();
    std::int32_t last_branch = -1;
    for (std::size_t i = range.first_body; i < end; ++i) {
        if (joined.kind[i] != Kind::branch) continue;
        last_branch = std::max(last_branch, joined.branch[i] - range.first_branch);
        if (selector.branch < 0 || joined.branch[i] != branch) continue;
        if (joined.s[i] > selector.at)
            next = std::min(next, joined.s[i]);
        else if (piece == end || joined.s[i] >= joined.s[piece])
            piece = i;
    }
    if (piece == end)
        throw std::out_of_range("branch " + std::to_string(selector.branch) + ", but tree " +
                                std::to_string(selector.tree) + " has no piece of it at " +
                                std::to_string(selector.at) + " (its branches go from 0 to " +
                                std::to_string(last_branch) + ")");
    const double from = joined.s[piece], to = std::isfinite(next) ? next : 1.0;
    const double t = to > from ? (std::min(selector.at, to) - from) / (to - from) : 0.0;
    return {piece, Vec3(0, 0, t * joined.size[piece][0])};
}

Selected by_nearest(const Tree& joined, const Selector& selector) {
    if (joined.size_bodies() == 0) throw std::out_of_range("nearest body, but there are no bodies");
    const DrawnPose pose = drawn_pose(joined);
    Selected best{0, Vec3::Zero()};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < joined.size_bodies(); ++i) {
        const Vec3 p = pose.R_wb[i].transpose() * Vec3(selector.nearest - pose.x_w[i]);
        const Vec3 on_axis(0, 0, std::clamp(p.z(), 0.0, joined.size[i][0]));
        const double distance = (p - on_axis).squaredNorm();
        if (distance < least) {
            least = distance;
            best = {i, on_axis};
        }
    }
    return best;
}

std::vector<Selected> by_level(const Tree& joined, std::int32_t level) {
    std::vector<Selected> selected;
    std::int32_t highest = -1;
    for (std::size_t i = 0; i < joined.size_bodies(); ++i) {
        if (joined.kind[i] != Kind::branch) continue;
        highest = std::max(highest, joined.level[i]);
        if (joined.level[i] == level) selected.push_back({i, joined.com[i]});
    }
    if (selected.empty())
        throw std::out_of_range("level " + std::to_string(level) + ", but the highest level of a branch is " +
                                std::to_string(highest));
    return selected;
}

} // namespace

std::vector<Selected> select(const Tree& joined, const std::vector<TreeRange>& trees, const Selector& selector) {
    switch (selector.by) {
    case Selector::By::body:
        return {by_body(joined, range_of(trees, selector.tree), selector)};
    case Selector::By::branch:
        return {by_branch(joined, range_of(trees, selector.tree), selector)};
    case Selector::By::nearest:
        return {by_nearest(joined, selector)};
    case Selector::By::level:
        return by_level(joined, selector.level);
    }
    return {};
}

} // namespace bough
