// grow.h: procedural trees by Weber and Penn's recursion ("Creation and Rendering of Realistic Trees", SIGGRAPH 1995).
//
// Parameters carry the paper's names. A stem of level n is a curve of nCurveRes segments turned by nCurve, nCurveBack,
// nCurveV, split by nSegSplits, tapered by nTaper; it bears nBranches children by Shape, BaseSize, nDownAngle, nRotate.
// Angles in degrees, lengths in metres or (nLength) as a fraction of the parent's length. Every random draw comes from a
// counter-based generator keyed by seed and stem path (random.h), so that the same seed gives the same bytes and one
// parameter changed leaves the other draws alone. "x with x_v" below is x + x_v u with u uniform in -1..1.
//
// Readings taken where the paper is open (weber_penn.h has the formulas):
//   Curve. Segments turn where they meet: nCurveRes - 1 turns of curve / nCurveRes about the stem's x, and of up to
//     curve_v / nCurveRes about a random axis across it, so that stems leave the plane. A negative curve_v makes a helix
//     of one turn whose direction stands |curve_v| off its axis.
//   Numbers. A number of children, leaves, fruit or splits that is not whole is rounded up as often as its fraction says
//     (the part of the paper's error diffusion, but one stem's number does not depend on another's).
//   Places. Child i of n sits at (i + 1/2) / n of the stem's length, on a trunk of its length above base_size. The part
//     of a stem that is split off is a branch of the same level whose parent is the stem it leaves, as thick as that
//     stem, and bears the children of its own part.
//   Rotation. Negative rotate: children at 180 + rotate on alternating sides.
//   Base splits. They replace the seg_splits of the first segment and spread evenly about the vertical.
//   Leaves. Their angles are those of level `levels` (of level 3 where levels is 4). A normal that would face down faces
//     up. leaf_bend turns the normal toward the outside of the tree and up. Negative `leaves`: all at the tip, in a fan
//     of `rotate` degrees. Fruit hangs straight down from the stem's surface by a stalk as long as its radius.
//   Radii. A radius is at least 0.05 of the stem's radius at its base, so that no tip is zero; nothing is thicker where
//     it starts than the stem it starts from. Flare acts on the lowest eighth of the trunk. Where flare, a rounded or
//     periodic taper need them, points are added between the segments' ends.
// Not here: pruning (and so shape 8, its envelope), lobes, leaf quality.
#pragma once
#include "../model/splines.h"
#include <array>
#include <cstdint>
#include <string>

namespace bough {

// What is outside these ranges is refused; of levels that do not grow, only the angles that leaves take are looked at.
struct LevelParameters {
    double down_angle = 0, down_angle_v = 0; // [deg] -360..360; negative V: from the base to the tip of the parent
    double rotate = 0, rotate_v = 0;         // [deg] -360..360; negative rotate: alternating sides
    double branches = 0;    // 0..1e6, most children of one stem of the level above; level 0: 0 or 1, one trunk
    double branch_dist = 0; // 0..1, 0: spread evenly, 1: in whorls where segments meet (1 - Arbaro's nBranchDist)
    double length = 0, length_v = 0; // > 0 and 0 <= V < length, fraction of the parent's (level 0: of scale)
    double taper = 1;                // 0..3; 0 cylinder, 1 cone, 2 cylinder with a rounded tip, 3 periodic
    double seg_splits = 0, split_angle = 0, split_angle_v = 0; // 0..100; [deg] -360..360
    double base_splits = 0;                                    // 0..100
    int curve_res = 1;                                         // 1..1000 segments; 2 or more where splits are
    double curve = 0, curve_back = 0, curve_v = 0;             // [deg] over the stem, -3600..3600
};

struct GrowthParameters {
    int shape = 0;  // 0 conical, 1 spherical, 2 hemispherical, 3 cylindrical, 4 tapered cylindrical, 5 flame,
                    // 6 inverse conical, 7 tend flame
    int levels = 3; // 1..4
    double scale = 10, scale_v = 0;              // [m] height; > 0 and 0 <= V < scale
    double base_size = 0.2;                      // 0..1 without 1, fraction of the trunk without branches
    double ratio = 0.02, ratio_power = 1.2;      // 0..1 without 0, radius / length of the trunk; 0..10
    double radius_scale = 1, radius_scale_v = 0; // > 0 and 0 <= V < scale, of the trunk (Arbaro's 0Scale, 0ScaleV)
    double flare = 0;                            // 0..100
    double attraction_up = 0;                    // -100..100, from level 2 on; negative: down
    std::array<LevelParameters, 4> level;
    double leaves = 0;       // -1e6..1e6, most leaves of one stem of the last level; negative: a fan (as in the paper)
    int leaf_shape = 0;      // >= 0, kept for the skin; 0 oval
    double leaf_scale = 0.1; // [m] > 0, length
    double leaf_scale_x = 0.5;              // > 0, width / length
    double leaf_bend = 0;                   // 0..1, turning to the light
    double fruits = 0, fruit_radius = 0.03; // 0..1e6, our own: most fruit of one stem of the last level; [m] > 0
    double least_radius = 0; // [m] 0..10, our own: no stem is thinner anywhere; wood carries its leaves down to 0.5 mm
    double most_slender = 0; // 0 (off)..1e6, our own: no child is longer than this times its radius at the base
    bool pipe_model = false; // our own: radii are raised to carry their side branches (pipe.h)
    std::string name = "tree";
};

// The tree that treegen makes without --species: a broad-leaved tree of 8 m.
GrowthParameters default_growth();

// Empty arrays of leaves, fruit where they are not wanted; `source` is left to the caller. Throws std::invalid_argument
// that names the parameter, its value and what was expected; also where splits would make more than 1e6 of one stem, or
// the tree comes to more than 5e7 branches, leaves and fruit. O(points).
Splines grow(const GrowthParameters&, std::uint64_t seed, bool with_leaves, bool with_fruit);

// The same tree with numbers of children, leaves and fruit changed so that segment() with default options makes `bodies`
// bodies of it, within 10 %. One factor f is searched: numbers of level n change by f^w, more for deeper levels; where one
// bough more is too wide a step, those of the last level by a second factor; where the deepest level would come to less
// than one stem a parent it is left out, leaves then growing on the level above. Lengths, and so the height, stay.
// Neighbouring numbers give similar trees. Cost: some five to ten growths of up to that size. Throws
// std::invalid_argument where the parameters cannot reach the number, or it exceeds 2e7.
Splines grow_bodies(const GrowthParameters&, std::uint64_t seed, bool with_leaves, bool with_fruit,
                    std::int64_t bodies);

} // namespace bough
