// segment_line.h: the line of one stem by the rules of Arbaro and tree-gen: where its segments lie, what splits off it,
// and how many children each segment bears (rules.h).
//
// Private to growth. A line depends on the stem's key, not on what was drawn before, so a stem may be traced as often
// as pruning needs it.
#pragma once
#include "stem.h"
#include <vector>

namespace bough {

struct SegmentStem : Stem {
    double scale = 0;        // [m] of the tree
    double child_length = 0; // longest children over this stem's length, one draw for all of them
    double parent_length = 0, parent_child_length = 0, parent_radius = 0; // parent_radius at its base, [m]
    double most_radius = 0;                                               // [m] of the parent where the stem grows
    double density = 0;                                                   // children a segment
    double split_share = 1, thinned = 1; // tree_gen: chance of a split that is taken; factor on density after splits
    bool clone = false;                  // splits off a stem of the same level
};

struct SegmentLine {
    std::vector<Segment> segment; // as in GrownStem
    std::vector<double> density;  // children of each
    Vec3 tip = Vec3::Zero();
    std::vector<SegmentStem> clones; // without parent branch
};

SegmentLine trace_line(const GrowthParameters&, const SegmentStem&);

} // namespace bough
