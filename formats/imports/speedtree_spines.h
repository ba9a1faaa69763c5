// speedtree_spines.h: the spines of a SpeedTree file as branches.
#pragma once
#include "imported_tree.h"
#include "speedtree_bones.h"
#include "speedtree_xml.h"

namespace bough::speedtree {

struct SpineBranches {
    std::vector<ImportedBranch> branches;
    std::vector<std::int32_t> branch_of_object; // its own spine's, else that of its nearest ancestor with one; -1: none
    std::vector<std::int32_t> branch_of_bone;   // the spine that begins nearest to the beginning of the bone's branch
};

// One branch per object with a spine; its parent is the nearest ancestor object with one, parent_at where the spine's
// first point projects to on it. Spine radii are in a scale of their own, found in this order (a note says which):
//   bones     median of Radius of a bone over the spine's radius at the bone's start (1 as a rule, 0.84 on trunks)
//   bark      median distance of bark points from the spine over the spine's radius beside them
//   metres    the radii are metres, positions in `unit` [m] if it is known, else in likely_unit of the largest extent
// A ratio within 0.8..1.1 of a power of ten or of a conversion between m, cm, mm, in and ft is taken as that factor.
// Spines without radii (no Radius, or all 0) have those of their bones, and what is still missing the pipe rule's
// (pipe_rule.h). `bones` may be empty. O(points), the matching of bones O(branches log branches).
SpineBranches branches_of_spines(File&, const BoneBranches& bones, std::optional<double> unit, ImportNotes&);

} // namespace bough::speedtree
