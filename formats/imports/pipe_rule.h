// pipe_rule.h: radii where a file has none: da Vinci's and Shinozaki's pipe rule, r^n = sum of r^n over what grows on,
// with n = 2.25 (between area-preserving 2 and Palubicki's 2.5).
#pragma once
#include "imported_tree.h"

namespace bough {

constexpr double pipe_exponent = 2.25;
constexpr double pipe_slenderness = 120; // of a trunk without any radius: its longest way to a tip over its base radius

// Fills every radius that is not above 0 (a single zero at a tip whose neighbour is known stays: a taper to a point).
// Between known points of a branch: straight over the arc. Before the first or beyond the last known one: the rule from
// there. On a branch without any: the rule, its scale the median over all points known; where nothing is known at all
// the thickest trunk's base gets 1/120 of its longest way. No filled branch is thicker than what it grows on is known to
// be there. Radii in the unit of the points. One note, with count and the tips' radius. O(points + branches log branches).
void fill_radii(std::vector<ImportedBranch>&, ImportNotes&);

} // namespace bough
