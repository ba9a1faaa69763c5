#include "wood_overrides.h"
#include "../base/monotone.h"
#include "of_kind.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bough {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

bool is_branch(const Tree& tree, std::size_t i) {
    return tree.kind[i] == Kind::branch;
}

// The body's parent bears it as a side branch.
bool is_fork(const Tree& tree, std::size_t i) {
    const std::int32_t p = tree.parent[i];
    return p >= 0 && is_branch(tree, i) && is_branch(tree, std::size_t(p)) && !continues_parent(tree, i);
}

void multiply(Tree& tree, const Wood& wood) {
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const WoodFactors& by = of_kind(wood, tree.kind[i]);
        tree.stiffness[i] *= by.stiffness;
        tree.damping[i] *= by.damping;
        tree.mass[i] *= by.density;
        tree.inertia[i] *= by.density;
    }
}

// Of each body whether the curve is for it.
std::vector<std::uint8_t> reached(const Tree& tree, const std::vector<TreeRange>& ranges, const WoodCurve& curve,
                                  std::size_t which) {
    std::vector<std::uint8_t> is(tree.size_bodies(), curve.on ? 0 : 1);
    if (!curve.on) return is;
    try {
        for (const Selected& body : select(tree, ranges, *curve.on)) is[body.body] = 1;
    } catch (const std::out_of_range& error) {
        throw std::out_of_range("wood/curves/" + std::to_string(which) + "/on: " + error.what());
    }
    for (std::size_t i = 0; i < is.size(); ++i)
        if (tree.parent[i] >= 0 && is[std::size_t(tree.parent[i])]) is[i] = 1;
    return is;
}

void apply(Tree& tree, std::size_t i, const WoodCurve& curve) {
    const double radius = tree.size[i][1];
    if (!curve.stiffness.empty()) {
        const double value = monotone_cubic(curve.radius, curve.stiffness, radius);
        Vec3& K = tree.stiffness[i];
        const double mean = (K.x() + K.y()) / 2;
        if (curve.relative)
            K *= value;
        else
            K = Vec3(value, value, mean > 0 ? K.z() / mean * value : K.z());
    }
    if (!curve.damping.empty()) {
        const double value = monotone_cubic(curve.radius, curve.damping, radius);
        tree.damping[i] = curve.relative ? tree.damping[i] * value : value;
    }
}

} // namespace

std::vector<double> way_to_fork(const Tree& tree) {
    const std::size_t n = tree.size_bodies();
    const auto place = [&](std::size_t i) { return std::abs(tree.joint_position[i].z()); }; // on its parent's axis
    std::vector<double> outward(n, never), inward(n, never);
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0 || !is_branch(tree, i)) continue;
        const auto p = std::size_t(tree.parent[i]);
        if (is_fork(tree, i))
            outward[p] = std::min(outward[p], place(i));
        else if (continues_parent(tree, i))
            outward[p] = std::min(outward[p], place(i) + outward[i]);
    }
    // What continues a body looks back along it: to the nearest of its forks, or to its joint and on.
    for (std::size_t i = 0; i < n; ++i)
        if (is_fork(tree, i)) inward[i] = 0;
    std::vector<double> near(n, never); // of a body that continues: to the forks on its parent
    std::vector<std::int32_t> next(n, -1);
    for (std::size_t i = 0; i < n; ++i)
        if (continues_parent(tree, i)) next[std::size_t(tree.parent[i])] = std::int32_t(i);
    for (std::size_t i = 0; i < n; ++i) {
        if (!is_fork(tree, i)) continue;
        const std::int32_t c = next[std::size_t(tree.parent[i])];
        if (c >= 0) near[std::size_t(c)] = std::min(near[std::size_t(c)], std::abs(place(std::size_t(c)) - place(i)));
    }
    for (std::size_t i = 0; i < n; ++i)
        if (continues_parent(tree, i)) inward[i] = std::min(near[i], place(i) + inward[std::size_t(tree.parent[i])]);
    for (std::size_t i = 0; i < n; ++i) inward[i] = std::min(inward[i], outward[i]);
    return inward;
}

WoodChanges override_wood(Tree& tree, const std::vector<TreeRange>& ranges, const Wood& wood) {
    const std::vector<Vec3> K = tree.stiffness;
    const std::vector<double> beta = tree.damping, mass = tree.mass;
    multiply(tree, wood);
    for (std::size_t k = 0; k < wood.curves.size(); ++k) {
        const std::vector<std::uint8_t> is = reached(tree, ranges, wood.curves[k], k);
        for (std::size_t i = 0; i < is.size(); ++i)
            if (is[i] && is_branch(tree, i)) apply(tree, i, wood.curves[k]);
    }
    WoodChanges changes;
    if (wood.fork) {
        const std::vector<double> way = way_to_fork(tree);
        for (std::size_t i = 0; i < way.size(); ++i) {
            changes.forks += is_fork(tree, i);
            if (!(way[i] < wood.fork->length)) continue;
            ++changes.near_forks;
            tree.stiffness[i] *= 1 + (wood.fork->factor - 1) * (1 - way[i] / wood.fork->length);
        }
    }
    for (std::size_t i = 0; i < K.size(); ++i) {
        changes.stiffness += K[i] != tree.stiffness[i];
        changes.damping += beta[i] != tree.damping[i];
        changes.mass += mass[i] != tree.mass[i];
    }
    return changes;
}

} // namespace bough
