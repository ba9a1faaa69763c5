// rules.h: by whose rules a tree grows, where programs that take Weber and Penn's parameters read the paper differently:
// in how many children a stem bears and where, in how stems split, curve, taper and are pruned.
//
// bough     the readings at the head of grow.h (grow_stems.cpp)
// arbaro    Arbaro 1.9: children are dealt out segment by segment, with jitter; what splits off shares its stem's
//           children; whole stems with what splits off them are pruned; shape 0 is a true cone (grow_segments.cpp)
// tree_gen  friggog's tree-gen: as Arbaro, but splits thin out, children of the last per mille of a stem are left out,
//           whorls, sideways bending (bend_v), tropism (grow_segments.cpp)
// sapling   Blender's add_curve_sapling: stems curve in vertical planes, each piece bears a child at its tip, the
//           trunk's children turn outward (grow_sapling.cpp)
// What they share with one another and with the paper is one struct, GrowthParameters. Each program deals fractions of
// children out by an error carried from stem to stem; here each stem starts with a random one of its own, which has the
// same mean and leaves stems independent of each other (as in grow.h).
#pragma once
#include <array>

namespace bough {

enum class GrowthRules { bough, arbaro, tree_gen, sapling };

// Parameters that only Sapling has, by its names where they are plain.
struct SaplingRules {
    enum class Rotation { original, rotate, random };
    Rotation rotation = Rotation::rotate;                    // rMode: how the trunk's children are turned
    int second_shape = 4;                                    // shapeS, 0..10 of stems of level 2 and more
    std::array<double, 4> custom_shape = {0.5, 1, 0.3, 0.5}; // shape 8: base, middle, place of the middle, top; 0.01..1
    std::array<double, 4> attract_out = {0, 0, 0, 0};        // 0..1, of each level: heading turned away from the trunk
    bool split_by_length = false;                            // splits in proportion to a stem's length
    double split_height = 0.2, split_bias = 0;               // 0..1 of the trunk: no splits below; -10..10
    double taper_crown = 0;                                  // 0..10: leaning parts of the trunk are shorter
    int rings = 0;                                           // 0..1000: the trunk's children in rings
    double branch_dist = 1;                                  // 0.1..100: > 1 toward the trunk's top
    double root_flare = 1;                                   // 1..100: factor on the radius of the trunk's first point
    bool old_down_angle = false, use_parent_angle = true;
    double leaf_scale_taper = 0; // -1..1: leaves smaller to a stem's tip (or, negative, to its base)
    double leaf_angle = 0;       // [deg] -360..360 tilt of the leaf's blade
    bool level_leaves = true;    // horzLeaves: blades turned about their length until level
};

} // namespace bough
