// curves.h: the splines' branches made ready for cutting: near-coincident points merged, arc lengths, least radii.
//
// Points nearer than `merge` times the tree's extent to the last point kept are left out (the earlier one stays, so a
// branch keeps its joint, its first point). A branch that has no length left is dropped: what grows on it goes to the
// place on its parent where it stood. The extent is the longest side of the bounding box of the points of the whole
// tree, all branches that stand on one root, so that a tree is treated alike alone and in a forest.
// Radii below `thin_radius` times the extent are raised to it, but for a branch's last point, which may be 0: a branch
// ends in a cone. So every piece has mass, and no joint stands on a section without stiffness.
// Reads checked Splines. O(points). Errors none.
#pragma once
#include "../model/splines.h"

namespace bough {

constexpr double thin_radius = 1e-5; // times the tree's extent: 0.1 mm on a tree of 10 m

// [m] Longest side of the bounding box of each root's tree, given to each of its branches. O(points).
std::vector<double> tree_extents(const Splines&);

struct CurvePlace {
    std::int32_t curve; // -1: the ground
    double at;          // fraction of its arc length
};

struct Curves {
    // Per curve, in the order of the splines; parents before children.
    std::vector<std::int32_t> branch; // which branch of the splines it is
    std::vector<CurvePlace> parent;
    std::vector<double> extent;      // [m] of the tree that it belongs to
    std::vector<std::int32_t> first; // curves + 1: its points

    // Per point.
    std::vector<Vec3> point;
    std::vector<double> radius; // [m]
    std::vector<double> arc;    // [m] from the curve's first point

    std::vector<std::int32_t> curve_of; // per branch of the splines: its curve, -1 for a dropped one
    std::vector<CurvePlace> host;       // per branch: for a dropped one, where what grows on it goes

    std::int64_t merged_points = 0, dropped_branches = 0, thin_points = 0;

    std::size_t size() const { return branch.size(); }
    double length(std::size_t c) const { return arc[first[c + 1] - 1]; }
    // Where fraction `at` of a branch of the splines lies.
    CurvePlace place(std::int32_t splines_branch, double at) const;
    // Position and radius at arc length s, linear between points. O(log points).
    Vec3 position_at(std::size_t c, double s) const;
    double radius_at(std::size_t c, double s) const;
};

Curves make_curves(const Splines&, double merge);

} // namespace bough
