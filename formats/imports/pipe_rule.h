// pipe_rule.h: radii where a file has none: da Vinci's and Shinozaki's pipe rule, r^n = sum of r^n over what grows on,
// with n = 2.25 (between area-preserving 2 and Palubicki's 2.5).
#pragma once
#include "imported_tree.h"

namespace bough {

constexpr double pipe_exponent = 2.25;
// Of a trunk without any radius: its longest way to a tip over its base radius. Trees whose files state radii are 20 to 45 times as
// high as their trunks are thick at the base; the way is 1 to 1.6 times the height.
constexpr double pipe_slenderness = 68;

// Fills every radius that is not above 0 (a single zero at a tip whose neighbour is known stays: a taper to a point).
// Between known points of a branch: straight over the arc. Before the first or beyond the last known one: the rule from
// there. On a branch without any: the rule, its scale the median over all points known; where nothing is known at all
// the thickest trunk's base gets 1/68 of its longest way, which `radii_guessed` of the notes tells of. No filled branch is thicker than what it grows
// on is known to be there. Radii in the unit of the points. One note, with count and the tips' radius. O(points + branches log branches).
void fill_radii(std::vector<ImportedBranch>&, ImportNotes&);

} // namespace bough
