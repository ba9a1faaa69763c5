// growth_parameters.h: what a tree grows from: Weber and Penn's parameters, those of programs that take them too (rules.h), and our own.
//
// How each is read stands in grow.h.
#pragma once
#include "../base/math.h"
#include "../model/wood.h"
#include "rules.h"
#include <array>
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
    // 0..1 without 1, height of the envelope's lower end over the tree's; < 0: base_size of level 0
    double prune_base = -1;
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
    // 0 or 1..4, our own: k parts of a split stem each have k^(-1/this) of its radius; 0: all
    double split_exponent = 0;
    // Our own: length of the highest boughs over the longest's, 0.01..1, where `shape` itself says 0.2, 0.5 or 0; -1: as it says.
    double crown_top = -1;
    // Our own: length of the shoot in which the trunk ends over the trunk's, 0 (none)..0.5. It is of the last level, with leaves.
    double leading_shoot = 0;
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

} // namespace bough
