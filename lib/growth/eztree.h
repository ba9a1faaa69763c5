// eztree.h: trees by the rules of ez-tree (npm @dgreenheck/ez-tree 1.1.0), number for number: the same preset and seed give
// the same branches, because its random generator and the order of its draws are kept.
//
// Rules. A branch of level n is `sections` straight pieces of equal length; after each, its orientation (Euler angles XYZ)
// changes by up to max(1, 1 / sqrt(radius)) * gnarliness about x and z, is twisted about its axis, and turned toward the
// growth force's orientation by strength / radius (away from it where negative; the whole orientation, not the axis
// alone) and toward the nearest bar of the trellis. Its radius falls by `taper` (evergreen: to nothing). Deciduous
// branches go on from their end in one of the next level, as thick as they end there, of as many sections; all bear
// children[n] more, from start[n + 1] of their length on, evenly about it, whose length in evergreens shrinks toward the
// tip. Branches of level `levels` bear leaves.count leaves, deciduous ones one more at their end.
// All lengths are in the preset's unit while it grows (gnarliness and force depend on it) and times `unit` in the result.
// A leaf is one triangle as long and wide as ez-tree's square; of a `double` billboard only the first of its two is made.
// The branch grown at an end is a branch of its own, at 1 of its parent.
#pragma once
#include "../model/splines.h"
#include <array>
#include <cstdint>
#include <string>

namespace bough {

constexpr int kEzLevels = 4; // entries that presets have: levels 0 to 3

struct EzTreeParameters {
    std::int64_t seed = 0;
    bool evergreen = false;
    double unit = 1; // [m] our own: length of one unit of the preset

    int levels = 3;                             // 0..3, of the last branches; 0: trunk only
    std::array<double, kEzLevels> angle{};      // [deg] of level n from its parent; not of level 0
    std::array<int, kEzLevels> children{};      // 0..1e6 on a branch of level n
    std::array<double, kEzLevels> gnarliness{}; // [rad]
    std::array<double, kEzLevels> length{};     // [unit] > 0
    std::array<double, kEzLevels> radius{};     // level 0: [unit] > 0; else over the parent's there
    std::array<int, kEzLevels> sections{};      // 1..1000
    std::array<double, kEzLevels> start{};      // 0..1 of the parent's length; not of level 0
    std::array<double, kEzLevels> taper{};      // 0..1 of the radius lost from base to end
    std::array<double, kEzLevels> twist{};      // [rad] a section
    Vec3 force_direction = {0, 1, 0};           // used as it is, as ez-tree does: presets have length 1
    double force_strength = 0;                  // [rad unit]

    double leaf_angle = 10;                       // [deg] from the branch
    int leaf_count = 0;                           // 0..1e6 on a branch of the last level
    double leaf_start = 0;                        // 0..1
    double leaf_size = 1, leaf_size_variance = 0; // [unit] > 0; 0..1 without 1

    struct Trellis {
        bool enabled = false;
        Vec3 position = {0, 0, -2};                  // [unit] middle of its lowest bar
        double width = 10, height = 20, spacing = 2; // [unit] > 0
        double strength = 0.02, most_distance = 3, falloff = 1;
    } trellis;

    std::string name = "ez-tree";
};

// Throws std::invalid_argument that names the parameter, its value and what was expected; also where there would be more
// than 5e7 branches and leaves. Leaves are drawn where not wanted too, since ez-tree's later draws depend on them. O(points).
Splines grow_eztree(const EzTreeParameters&, bool with_leaves);

// Branches of each level that the parameters make, without growing: deciduous b[n+1] = b[n] (children[n] + 1), evergreen
// b[n] children[n].
std::array<std::int64_t, kEzLevels> eztree_branches(const EzTreeParameters&);

} // namespace bough
