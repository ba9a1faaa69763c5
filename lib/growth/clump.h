// clump.h: the leaves that a clump (is_clump in tree.h) is drawn as.
//
// A body that stands for n leaves is drawn as so many of them, each of the body's proportions and of its area (where the tree says a leaf's
// size, of its proportions and of all their area) over their number. So what is drawn has the clump's area. Where all clumps together would
// come to more than `all` leaves (two a body, 10 000 at least, 200 000 at most, but 64 a clump), each is drawn as the same part of its own, one at
// least. So leaves are enlarged alike all over the crown.
// They fill an ellipsoid about the body's centre of mass evenly. Its axes are width, 0.6 width, length; where the tree says a leaf's size, twice
// the way from the centre to the length's end in place of the length. The middle of leaf k is point k of a sequence of low discrepancy (the
// additive recurrence of three irrationals). Leaves point away from the clump's joint and middle and droop a little. Those of a clump that hangs,
// by more than 30 degrees below level, droop the more the steeper it hangs, and the leaves of one that hangs plumb do so too; those of a species
// whose twigs hang do so wherever the clump points. Their upper faces look up and outward. All of it is drawn from the body's
// index, so that the same tree looks the same whoever draws it.
#pragma once
#include "../model/tree.h"

namespace bough {

// How many leaves each body is drawn as, 1..leaf_count; empty where the tree has no leaf_count: one each. all: 0 for the above. O(bodies).
std::vector<std::int32_t> clump_leaves_drawn(const Tree&, std::int64_t all = 0);

// A leaf of a clump, in the clump's body frame.
struct ClumpLeaf {
    Vec3 foot; // [m] where its blade begins
    Mat3 axes; // its width, its normal, its length
};

// R_wb: how the body stands when drawn. Count: as above. hang: 0..1, how plumb leaves hang at least. O(count).
std::vector<ClumpLeaf> clump_leaves(const Tree&, std::size_t body, const Mat3& R_wb, std::int32_t count,
                                    double hang = 0);

// Length, width, thickness [m] of one of `count` leaves.
Vec3 clump_leaf_size(const Tree&, std::size_t body, std::int32_t count);

} // namespace bough
