// grow.h: procedural trees by Weber and Penn's recursion ("Creation and Rendering of Realistic Trees", SIGGRAPH 1995).
//
// Parameters carry the paper's names. A stem of level n is a curve of nCurveRes segments turned by nCurve, nCurveBack,
// nCurveV, split by nSegSplits, tapered by nTaper; it bears nBranches children by Shape, BaseSize, nDownAngle, nRotate.
// Angles in degrees, lengths in metres or (nLength) as a fraction of the parent's length. Every random draw comes from a
// counter-based generator keyed by seed and stem path, so that the same seed gives the same bytes for any thread count
// and one parameter changed leaves the other draws alone.
#pragma once
#include "../model/splines.h"
#include <array>
#include <cstdint>
#include <string>

namespace bough {

struct LevelParameters {
    double down_angle = 0, down_angle_v = 0;  // [deg] negative V: varies along the parent
    double rotate = 0, rotate_v = 0;          // [deg] negative rotate: alternating sides
    double branches = 0;                      // most children of one stem of the level above
    double branch_dist = 0;                   // 0: spread evenly, 1: whorls (Arbaro's nBranchDist)
    double length = 0, length_v = 0;          // fraction of the parent's (level 0: of scale)
    double taper = 1;                         // 0 cylinder, 1 cone, 2 rounded tip, 3 periodic
    double seg_splits = 0, split_angle = 0, split_angle_v = 0;
    double base_splits = 0;
    int curve_res = 1;
    double curve = 0, curve_back = 0, curve_v = 0;  // [deg] over the stem
};

struct GrowthParameters {
    int shape = 0;          // 0 conical, 1 spherical, 2 hemispherical, 3 cylindrical, 4 tapered cylindrical, 5 flame,
                            // 6 inverse conical, 7 tend flame, 8 envelope
    int levels = 3;         // 1..4
    double scale = 10, scale_v = 0;  // [m] height
    double base_size = 0.2;          // fraction of the trunk without branches
    double ratio = 0.02, ratio_power = 1.2, flare = 0;
    double attraction_up = 0;  // tropism
    std::array<LevelParameters, 4> level;
    double leaves = 0;           // most leaves of one stem of the last level; negative: a fan (as in the paper)
    int leaf_shape = 0;          // kept for the skin; 0 oval
    double leaf_scale = 0.1, leaf_scale_x = 0.5, leaf_bend = 0;  // [m] length, width / length, turning to the light
    double fruits = 0, fruit_radius = 0.03;  // our own: most fruit of one stem of the last level, [m]
    std::string name = "tree";
};

// The tree that treegen makes without --species: a broad-leaved tree of 8 m.
GrowthParameters default_growth();

// Throws std::invalid_argument that names the parameter for values outside the ranges documented in grow.cpp.
Splines grow(const GrowthParameters&, std::uint64_t seed, bool with_leaves, bool with_fruit);

// Parameters changed (numbers of children first, then levels' curve resolution; height kept) so that the tree has `bodies` bodies,
// within 10 %, after segmentation by the default options; and the splines themselves. Searches over a single factor,
// so neighbouring N give similar trees. Throws std::invalid_argument where the parameters cannot reach the number.
Splines grow_bodies(const GrowthParameters&, std::uint64_t seed, bool with_leaves, bool with_fruit, std::int64_t bodies);

} // namespace bough
