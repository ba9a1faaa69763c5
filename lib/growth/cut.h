// cut.h: where a branch is cut into pieces (segment.h), by arc length and turning.
//
// Pieces wanted of a curve of length L: with a segment length l > 0: ceil(L / l). By default
//   round(11 sqrt(L / extent)), at least 1, at most L / (2 r_base)
// with the extent of the whole tree (curves.h) and the curve's base radius: 11 pieces for a trunk as high as the tree, 6
// for a bough of a third of it, 3 for one of a tenth, 1 for a twig of 1/50; no piece shorter than its branch is thick.
// That depends on the splines alone. `grow` >= 1 lengthens pieces and the turning allowed alike; below 1 it
// shortens pieces alone, if need be below their branch's thickness.
// Turning. A cut is forced at each point where the tangent has turned by more than max_bend since the last forced cut,
// but not where it would leave a stretch shorter than the branch's radius there: so short a piece bends nothing. If as
// many even pieces as wanted, or as stretches so found, or up to half as many again, keep the tangent of each within
// max_bend of its first, they are taken (a smooth curve); else the forced cuts are (a corner), and the stretches between
// are cut evenly. A piece whose ends all but meet (a loop, a fold) is cut once more at its point farthest from its
// start, so that every piece has a direction.
#pragma once
#include "curves.h"

namespace bough {

struct CutRule {
    double segment_length = 0; // [m] 0: the default
    double max_bend = 0.35;    // [rad]
    double grow = 1;           // > 0; infinity: as few pieces as can be
};

// Arc lengths of curve c's cuts, 0 and its length included, into `cuts` (replaced); returns the number of pieces. If
// that would exceed `limit`, returns limit + 1 without cutting. O(points + pieces).
std::int64_t cut_curve(const Curves&, std::size_t c, const CutRule&, std::int64_t limit, std::vector<double>& cuts);

// Pieces of all curves, or limit + 1 if there are more: at once where as many as are wanted would be. O(points + pieces).
std::int64_t count_pieces(const Curves&, const CutRule&, std::int64_t limit);

} // namespace bough
