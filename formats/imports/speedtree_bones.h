// speedtree_bones.h: the bones of a SpeedTree file as branches: all that an export without spines has, and the yardstick
// for the scale of spine radii in one that has them.
#pragma once
#include "imported_tree.h"
#include "speedtree_xml.h"

namespace bough::speedtree {

// Gives every bone an end. One without takes the start of the child that goes on (same Generator, then the longest way
// to a tip, then the straightest); at a tip it is as long as the step from its parent, in the same direction; a bone
// alone gets no length. Notes say how many. O(bones).
void complete_ends(std::vector<Bone>&, ImportNotes&);

// Gives every bone a radius. One without (or 0) takes that of its nearest ancestor that has one, times the square root
// of the ratio of the lengths of wood beyond each (the pipe model); a root without, the same from the thickest bone of
// the file; in a file without any, a root has the pipe rule's part of its longest way to a tip (pipe_rule.h). Notes say so.
void complete_radii(std::vector<Bone>&, ImportNotes&);

struct BoneBranches {
    std::vector<ImportedBranch> branches;
    std::vector<std::int32_t> branch_of; // of each bone
};

// A bone that starts where its parent ends and has its Generator goes on its branch; of several the straightest does,
// the others and all bones elsewhere begin branches, at their own start, which is kept where it lies off the parent's
// axis; parent_at is the place it projects to on the parent bone. A bone's Radius is the one at its start; the tip's
// continues the taper of the last two bones, kept between 0.1 and 1 of the last (a single bone keeps its radius).
// Needs ends. O(bones).
BoneBranches branches_of_bones(const std::vector<Bone>&);

} // namespace bough::speedtree
