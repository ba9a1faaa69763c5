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
//   Attraction. Each level has its own (the paper: one, from level 2 on).
//   Numbers. A number of children, leaves, fruit or splits that is not whole is rounded up as often as its fraction says
//     (the part of the paper's error diffusion, but one stem's number does not depend on another's).
//   Places. Child i of n sits at (i + 1/2) / n of the stem's length above its base_size. The part of a stem that is split
//     off is a branch of the same level whose parent is the stem it leaves, as thick as that
//     stem unless split_exponent says otherwise, and bears the children of its own part.
//   Rotation. Negative rotate: children at 180 + rotate on alternating sides.
//   Base splits. They replace the seg_splits of the first segment and spread evenly about the vertical.
//   Leaves. Their angles are leaf_angles or, where that is empty, those of level `levels` (of level 3 where levels is 4).
//     How many a stem bears follows leaf_distrib, the shape of ShapeRatio by its place on its parent (the paper: 4). A
//     normal that would face down faces up. leaf_bend turns the normal toward the outside of the tree and up. Negative `leaves`: all at the tip, in a fan
//     of `rotate` degrees. Fruit hangs straight down from the stem's surface by a stalk.
//   Blossoms. At random places of stems of the last level; petals stand evenly round a flower that faces away from its
//     stem and half up, each leaning 35 degrees off its plane.
//   Pruning. A stem of level 1 or more that leaves the envelope is drawn again, each time a tenth shorter, until it does
//     not, at most 24 times (to 8 % of its length), then at prune_ratio of the way there; its radius is that of its new
//     length. Parts that are split off are each pruned alone, their start kept.
//   Ground. A stem of level 1 or more that comes nearer to it than 0.02 of the trunk's length, and lower than it begins, is drawn shorter
//     likewise: a weeping willow's shoots end above it.
//   Radii. A radius is at least 0.05 of the stem's radius at its base, so that no tip is zero; nothing is thicker where
//     it starts than the stem it starts from. Flare acts on the lowest eighth of the trunk. Where flare, a rounded or
//     periodic taper need them, points are added between the segments' ends.
// Not here: lobes (bodies are round).
#pragma once
#include "../model/splines.h"
#include "../model/wood.h"
#include "rules.h"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

// What is outside these ranges is refused; of levels that do not grow, only the angles that leaves take are looked at.
struct LevelParameters {
    double down_angle = 0, down_angle_v = 0; // [deg] -360..360; negative V: from the base to the tip of the parent
    double rotate = 0, rotate_v = 0;         // [deg] -360..360; negative rotate: alternating sides
    double branches = 0;    // 0..1e6, most children of one stem of the level above; level 0: 0 or 1, one trunk (arbaro,
                            // tree_gen: 0..1e4 trunks)
    double base_size = 0;   // 0..1 without 1, fraction of a stem of this level, from its base, without children
    double radius_mod = 1;  // > 0 and at most 1e3, factor on the radius of stems of this level
    double branch_dist = 0; // 0..1, 0: spread evenly, 1: in whorls where segments meet (1 - Arbaro's nBranchDist);
                            // tree_gen: 0..100, 0 alternate, 1 opposite, more: whorls of branch_dist + 1
    double length = 0, length_v = 0; // > 0 and 0 <= V < length, fraction of the parent's (level 0: of scale)
    double taper = 1;                // 0..3; 0 cylinder, 1 cone, 2 cylinder with a rounded tip, 3 periodic
    double taper_power = 1;          // 0.1..10, our own: the stem's taper to this power; 0.5 makes a cone a paraboloid
    double seg_splits = 0, split_angle = 0, split_angle_v = 0; // 0..100; [deg] -360..360
    double base_splits = 0;                                    // 0..100
    int curve_res = 1;                                         // 1..1000 segments; 2 or more where splits are
    double curve = 0, curve_back = 0, curve_v = 0;             // [deg] over the stem, -3600..3600
    double bend_v = 0;        // [deg] -3600..3600, tree_gen: sideways, curve_v then acting in the plane of curve
    double attraction_up = 0; // -100..100; negative: down
};

struct GrowthParameters {
    GrowthRules rules = GrowthRules::bough;
    int shape = 0;  // 0 conical, 1 spherical, 2 hemispherical, 3 cylindrical, 4 tapered cylindrical, 5 flame,
                    // 6 inverse conical, 7 tend flame, 8 the pruning envelope
    int levels = 3; // 1..4
    double scale = 10, scale_v = 0; // [m] height; > 0 and 0 <= V < scale (V = scale but for bough)
    double ratio = 0.02,
           ratio_power = 1.2; // 0..1 without 0, radius / length of the trunk; 0..10 (from -10 but for bough)
    double radius_scale = 1, radius_scale_v = 0; // > 0 and 0 <= V < scale, of the trunk (Arbaro's 0Scale, 0ScaleV)
    double flare = 0;                            // 0..100 (from -1 but for bough)
    double trunk_spread = 0;                     // [m] 0..1e4, arbaro: how far trunks stand from the middle
    Vec3 tropism = Vec3::Zero();   // +-1000, tree_gen: segments turn 10 degrees times the sine toward it; level 0 and 1
                                   // toward its level part
    double prune_ratio = 0;        // 0..1, how far stems are cut back to the envelope; 0: not pruned
    double prune_width = 0.5;      // > 0 and at most 10, radius of the envelope over the trunk's length
    double prune_width_peak = 0.5; // 0..1 without both, height of the widest place over the crown's
    double prune_base =
        -1; // 0..1 without 1, height of the envelope's lower end over the tree's; < 0: base_size of level 0
    double prune_power_low = 0.5, prune_power_high = 0.5; // 0..10, of the envelope's curve below and above it
    std::array<LevelParameters, 4> level;
    double leaves = 0;    // -1e6..1e6, most leaves of one stem of the last level; negative: a fan (as in the paper)
    int leaf_distrib = 4; // 0..8, how leaves' numbers depend on the stem's place on its parent (ShapeRatio)
    std::vector<double> leaf_angles; // [deg] down_angle, down_angle_v, rotate, rotate_v of leaves; empty: the level's
    double leaf_scale = 0.1, leaf_scale_v = 0; // [m] length; > 0 and 0 <= V < scale
    double leaf_scale_x = 0.5;                 // > 0, width / length
    double leaf_bend = 0;                      // 0..1, turning to the light
    double leaf_stem = 0;                      // -100..100, arbaro: stalk between stem and leaf, over the leaf's length
    double blossom_rate = 0;                   // 0..1, tree_gen: share of leaves that are flowers
    SaplingRules sapling;                      // looked at by sapling alone
    // Our own: most flowers of one stem of the last level, 0..1e6; petals of a flower, 1..1000; a petal's length [m] > 0
    // and its width over that, > 0.
    double blossoms = 0;
    int petals = 5;
    double petal_scale = 0.014, petal_scale_x = 0.9;
    double fruits = 0, fruit_radius = 0.03; // 0..1e6, our own: most fruit of one stem of the last level; [m] > 0
    double fruit_stalk = 1;                 // 0.01..1000, our own: length of its stalk over its radius
    double split_exponent =
        0;                    // 0 or 1..4, our own: k parts of a split stem each have k^(-1/this) of its radius; 0: all
    double least_radius = 0;  // [m] 0..10, our own: no stem is thinner anywhere; wood carries its leaves down to 0.5 mm
    double most_slender = 0;  // 0 (off)..1e6, our own: no child is longer than this times its radius at the base
    double pipe_exponent = 0; // 0 (off) or 1..4, our own: radii are raised to carry their side branches (pipe.h)
    // Our own: radii are raised until no branch is turned more than this by its load, 0 (off) or 0.01..3 [rad] (carry.h), and until the whole tree
    // stands and no branch sways more slowly than it (stand.h), made of this wood.
    double most_sag = 0;
    Material wood = wood_presets().front();
    std::string name = "tree";
};

// What grows on the wood.
struct Items {
    bool leaves = false, petals = false, fruit = false;
};

// The tree that treegen makes without --species: a broad-leaved tree of 8 m.
GrowthParameters default_growth();

// Empty arrays of leaves (petals among them), fruit where they are not wanted; `source` is left to the caller. Throws std::invalid_argument
// that names the parameter, its value and what was expected; also where splits would make more than 1e6 of one stem, or
// the tree comes to more than 5e7 branches, leaves and fruit. O(points).
Splines grow(const GrowthParameters&, std::uint64_t seed, const Items&);

// The same tree, whatever the number, which it carries along (Splines::bodies): what segment() makes of it, within a tenth from 100 bodies on,
// by fewer (resolve.h) or by cutting it more finely. Throws std::invalid_argument beyond 1 to 2e7 too, and where the tree is not to be had on so few.
Splines grow_bodies(const GrowthParameters&, std::uint64_t seed, const Items&, std::int64_t bodies);

} // namespace bough
