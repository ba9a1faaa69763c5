// loose_trunks.h: trees of which some begin in the air, because the program that made them lost the wood between: their
// trunks are joined to the nearest wood of another.
#pragma once
#include "imported_tree.h"

namespace bough {

// What they grow on: attach.h, each trunk beginning with its first point. Trunks stay that begin in the lowest twentieth of the
// height, or are farther from all others than half of their own wood is long, or are trees of a slope: such a trunk begins in the
// lowest twentieth of its own height, no steeper than 45 degrees above the tree that it would be joined to, and five of its radii
// away; it has a quarter of that tree's radius and height, or is farther away than it is high.
// A joint off the parent's axis by more than the parent's radius there and its own gets a straight piece from the axis.
// `up` is 'y' or 'z'. A note counts the trunks joined and gives the widest gap. Nothing is done to a single trunk.
// Each branch has a point. O(points log points).
void join_loose_trunks(std::vector<ImportedBranch>&, char up, ImportNotes&);

} // namespace bough
