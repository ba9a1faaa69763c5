// segment.h: makes rigid bodies of splines (§3, §10). Branches are cut into frustums by arc length and curvature. Leaves and fruit are jointed to the
// piece that they grow on. Each body gets its mass, inertia, stiffness and damping.
//
// Cuts. A piece of a branch is at most `segment_length` long (by default after the rule of cut.h) and turns by at most `max_bend`. Between forced
// cuts all pieces are equally long. Joints lie on the curve. Points nearer than `merge` to the one before are merged. A side branch's joint stays
// where it was drawn, off the parent's axis.
// Stiffness. A joint's compliance is half the parent piece's and half the child piece's, integrated over the taper. At the ground, and where a side
// branch leaves, it is the child's half alone. Bending has 1 / (E I), twist 1 / (G J). K = (kx, ky, kz).
// Damping. beta = 2 zeta / omega, with omega the branch's own first bending frequency (branch_mode.h).
// Budget. With max_bodies, or where the splines say a number (Splines::bodies; not with a segment_length), a tree of more bodies than that is
// resolved by fewer (resolve.h): it stays the same tree, and what is left out becomes part of what carries it. A tree of fewer is cut more finely,
// evenly, for Splines::bodies. Leaves and fruit stay one body each. max_bodies never makes more.
// Order. Bodies stand branch by branch, a branch's pieces in order, parents before children. Leaves and fruit follow all branches.
// A branch without length is left out and counted (curves.h). cut.h has the exact rules of cutting.
// Cost O(points + bodies) of the whole tree; with a budget some eighty times that.
// Throws std::invalid_argument ("segment_length: is nan, expected ...") for options out of their ranges, where max_bodies is less than the least
// number possible (and says which that is), and where there are more bodies than an index holds.
#pragma once
#include "../model/splines.h"
#include "../model/tree.h"
#include "../model/wood.h"
#include <cstdint>

namespace bough {

struct SegmentOptions {
    double segment_length =
        0;                  // [m] longest piece, 0 or more; 0: by the default rule, which depends on the splines alone
    double max_bend = 0.35; // [rad] largest turning of the curve within one piece, above 0
    std::int64_t max_bodies = 0; // 0 or more; 0: as the splines say, or as many as come
    double merge = 1e-6;         // 0 or more: points nearer than this times the tree's extent are one
};

struct SegmentReport {
    std::int64_t merged_points = 0;    // near-coincident points
    std::int64_t dropped_branches = 0; // without length after merging, and whatever grows on them moved to the parent
    std::int64_t thin_points = 0;      // radii raised to the least radius that still gives a positive mass
    std::int64_t joined_fruit = 0;     // that a number of bodies left to the wood that bears it
    double segment_length = 0;         // [m] longest piece, as used
};

// Returns how many bodies segment() would make; throws as it does. O(points), with a budget as segment().
std::int64_t count_bodies(const Splines&, const SegmentOptions&);

// Has segment() make so many bodies of the splines, within a tenth from 100 on (Splines::bodies). Throws std::invalid_argument ("bodies: is ...") for
// less than 1, for more than 2e7, and for fewer than the tree can come to. O(branches), for a few bodies as segment().
void ask_for_bodies(Splines&, std::int64_t bodies);

Tree segment(const Splines&, const Material&, const SegmentOptions&, SegmentReport* report = nullptr);

} // namespace bough
