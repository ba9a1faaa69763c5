// stem.h: one stem of Weber and Penn's recursion while it grows: where it starts, and the segments it was made of.
//
// Private to growth. A stem's own frame has z along it and x about which it curves and its children bend down.
#pragma once
#include "../model/splines.h"
#include "bark.h"
#include "turn.h"
#include "weber_penn.h"
#include <span>

namespace bough {

// What a number is drawn for. Only ever add at the end: the values are part of every tree's random numbers.
enum class Draw : std::uint8_t {
    trunk,
    child,
    clone,
    leaf,
    fruit, // descendants
    scale,
    radius_scale,
    length,
    children,
    down_angle,
    rotate,
    curve,
    curve_axis,
    splits,
    base_splits,
    split_angle,
    split_sign,
    split_spread,
    leaves,
    fruits,
    leaf_scale,
    blossom,
    blossoms,
    place, // of children, jitter
    bend,
    split_share, // whether a stem splits where it could
    trunk_place,
    leader // descendant
};

struct Stem {
    RandomKey key = 0;
    std::int32_t parent = -1; // branch it grows on or, for a clone, goes on from
    double parent_at = 0;
    int level = 0;
    Vec3 position = Vec3::Zero();  // [m]
    Quat frame = Quat::Identity(); // world from stem, of its first segment
    double length = 0, radius = 0; // [m] of the whole stem, also for a clone; radius at the base, without flare
    double place = 0;              // offset / length of the parent; of the whole stem, also for a clone
    double crown = 1;              // crown_ratio at the place (level 1)
    double share = 1;              // of the radius, left by splits before its first segment
    int first_segment = 0;         // a clone starts at this segment's start
    double unbend = 0;             // [rad] turned back in each segment after splits
};

struct Segment {
    Vec3 position; // of its start
    Quat frame;
    double share = 1; // of the stem's radius, left by splits
};

// A stem that has been drawn: segment i of `segment` is the stem's number first_segment + i.
struct GrownStem {
    const Stem& stem;
    std::int32_t branch;
    std::span<const Segment> segment;
    int curve_res;

    double start() const { return stem.length * stem.first_segment / curve_res; } // [m] along the whole stem
    double fraction(double offset) const { return std::clamp((offset - start()) / (stem.length - start()), 0.0, 1.0); }
    const Segment& segment_at(double offset) const;
    Vec3 point_at(double offset) const;
};

// One leaf that grows at `offset` [m] of the stem, `turned`: z its length, y its normal.
void add_leaf(const GrowthParameters&, const GrownStem&, double offset, const Quat& turned, double length,
              Splines& out);

// The petals of one flower at `center`, which faces along `axis`, `size` times as large as usual.
void add_flower(const GrowthParameters&, std::int32_t branch, double at, const Vec3& center, const Vec3& axis,
                double size, Splines& out);

// Throws std::invalid_argument where a tree with `waiting` more stems is larger than grow() allows.
void check_size(const Splines&, std::size_t waiting);

// grow() by bough's rules, by Arbaro's and tree-gen's, by Sapling's (rules.h); thickening is left to it.
void grow_stems(const GrowthParameters&, std::uint64_t seed, const Items&, Splines& out);
void grow_segments(const GrowthParameters&, std::uint64_t seed, const Items&, Splines& out);
void grow_sapling(const GrowthParameters&, std::uint64_t seed, const Items&, Splines& out);

// Leaves, flowers and fruit of a stem of the last level, appended to `out`.
void grow_leaves(const GrowthParameters&, const GrownStem&, Splines& out);
void grow_blossoms(const GrowthParameters&, const GrownStem&, Splines& out);
void grow_fruits(const GrowthParameters&, const GrownStem&, Splines& out);

} // namespace bough
