#include "eztree_check.h"
#include "../base/shortest_text.h"
#include "in_range.h"
#include <stdexcept>

namespace bough {
namespace {

constexpr double kMostEztreeItems = 5e7; // branches and leaves

void positive(const std::string& name, double value) {
    if (!(value > 0 && value <= 1e6)) refuse(name, value, "more than 0 and at most 1e6");
}

} // namespace

void check_eztree(const EzTreeParameters& p) {
    positive("unit", p.unit);
    within("branch.levels", p.levels, 0, kEzLevels - 1);
    for (std::size_t n = 0; n <= static_cast<std::size_t>(p.levels); ++n) {
        const std::string at = "." + std::to_string(n);
        positive("branch.length" + at, p.length[n]);
        positive("branch.radius" + at, p.radius[n]);
        within("branch.sections" + at, p.sections[n], 1, 1000);
        within("branch.gnarliness" + at, p.gnarliness[n], -100, 100);
        // A branch that ends in nothing can bear none that goes on from there.
        within("branch.taper" + at, p.taper[n], 0, 1);
        if (!p.evergreen && n < static_cast<std::size_t>(p.levels) && p.taper[n] == 1)
            throw std::invalid_argument("branch.taper" + at + ": is 1, expected less where a branch goes on");
        within("branch.twist" + at, p.twist[n], -100, 100);
        if (n > 0) within("branch.angle" + at, p.angle[n], -360, 360);
        if (n > 0) within("branch.start" + at, p.start[n], 0, 1);
        if (n < static_cast<std::size_t>(p.levels)) within("branch.children" + at, p.children[n], 0, 1e6);
    }
    for (int k = 0; k < 3; ++k) within("branch.force.direction", p.force_direction[k], -1e3, 1e3);
    within("branch.force.strength", p.force_strength, -1e6, 1e6);
    within("leaves.angle", p.leaf_angle, -360, 360);
    within("leaves.count", p.leaf_count, 0, 1e6);
    within("leaves.start", p.leaf_start, 0, 1);
    positive("leaves.size", p.leaf_size);
    if (!(p.leaf_size_variance >= 0 && p.leaf_size_variance < 1))
        throw std::invalid_argument("leaves.sizeVariance: is " + shortest_text(p.leaf_size_variance) +
                                    ", expected at least 0 and less than 1");
    double branches = 1, all = 1;
    for (std::size_t n = 0; n < static_cast<std::size_t>(p.levels); ++n) {
        branches *= p.children[n] + (p.evergreen ? 0 : 1);
        all += branches;
    }
    all += branches * (p.leaf_count + (p.evergreen ? 0 : 1));
    if (!(all <= kMostEztreeItems))
        throw std::invalid_argument("branch.children: make " + shortest_text(all) +
                                    " branches and leaves, expected at most 5e7");
    if (!p.trellis.enabled) return;
    for (int k = 0; k < 3; ++k) within("trellis.position", p.trellis.position[k], -1e6, 1e6);
    positive("trellis.width", p.trellis.width);
    positive("trellis.height", p.trellis.height);
    positive("trellis.spacing", p.trellis.spacing);
    within("trellis.force.strength", p.trellis.strength, -1e6, 1e6);
    positive("trellis.force.maxDistance", p.trellis.most_distance);
    within("trellis.force.falloff", p.trellis.falloff, 0, 100);
}

} // namespace bough
