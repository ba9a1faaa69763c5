// spline_nodes.h: splines as nodes that name their parent node, for the writers of skeleton formats (SWC, tree files): the
// way back from skeleton.h.
//
// Each branch's points are nodes. Where a branch leaves its parent between two points, the parent gets a node there, with
// the radius in between; a branch that begins off its parent's axis, by more than 1e-6 of the parent's length, gets a piece
// from the axis to its own first point. What a node cannot say is counted (below). Read back by skeleton.h the polylines
// and the radii at their points are the same.
// Reads checked Splines. O(points + branches log branches), no recursion.
#pragma once
#include "lib/model/splines.h"

namespace bough {

struct SplineNodes {
    std::vector<std::int32_t> parent; // node index < own, -1: a root
    std::vector<Vec3> point;          // [m]
    std::vector<double> radius;       // [m] at the point
    std::vector<std::int32_t> tree;   // number of its root among the roots

    // What is lost, counts of branches.
    std::size_t off_axis = 0; // begin off their parent's axis: a piece leads to them
    // They have another radius at their base than at their second point: read back as the second's
    std::size_t base_radius = 0;
    // They leave their parent at its tip, or where it is no thicker: may be read as going on with it
    std::size_t goes_on = 0;
    std::size_t at_foot = 0; // leave their parent at its foot: read back as trunks, or as growing on what that grows on
    std::size_t trees = 0;   // how many roots
};

SplineNodes nodes_of(const Splines&);

// One line for each loss, with its count; leaves, fruit and looks, which skeletons do not hold, too.
std::vector<std::string> losses(const SplineNodes&, const Splines&);

} // namespace bough
