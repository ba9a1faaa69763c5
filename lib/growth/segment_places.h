// segment_places.h: how many children or leaves a stem bears by the rules of Arbaro and tree-gen, and where (rules.h).
//
// Private to growth. Stems are those that prune and set_density have dealt with (grow_segments.cpp).
#pragma once
#include "segment_line.h"

namespace bough {

// Where a child or leaf grows on its stem, and how it is turned about it.
struct Insertion {
    double offset; // [m]
    double turn;   // [deg]
};

inline bool by_arbaro(const GrowthParameters& p) {
    return p.rules == GrowthRules::arbaro;
}

// Children, or leaves, of a whole stem of this length, before splits take their part.
double segment_children(const GrowthParameters&, const SegmentStem&);
double segment_leaves(const GrowthParameters&, const SegmentStem&);

// The places of a stem's children, whose level is `child`, or of its leaves.
std::vector<Insertion> segment_places(const GrowthParameters&, const SegmentStem&, const SegmentLine&,
                                      const LevelParameters& child);

// [deg] of a child or leaf of that level at `offset` [m] of its parent.
double segment_down_angle(const GrowthParameters&, const SegmentStem& parent, const LevelParameters&, double offset,
                          RandomKey key);

// Leaves, and flowers in their place (tree-gen), of a stem of the last level.
void grow_segment_leaves(const GrowthParameters&, const SegmentStem&, const GrownStem&, const SegmentLine&,
                         const Items&, Splines& out);

} // namespace bough
