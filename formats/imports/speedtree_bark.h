// speedtree_bark.h: radii of a SpeedTree file's bones from the bark that the same file holds. (Private to speedtree.cpp.)
#pragma once
#include "bark.h"
#include "import.h"

namespace bough::speedtree {

// The triangles of all objects, points in the file's unit and axes; a point's bone is that of the first of its vertices that has one.
// Throws InputError FILE:LINE: points, vertices and bones that do not exist, lists of unequal length. O(size of the file).
BarkSurface parse_bark(std::string_view content, const std::string& name, const std::vector<Bone>&);

// Radius of a bone is 0.84 to 1.0 of the wood's, by one factor along a branch: each branch's radii are multiplied by the median, over
// its bones, of the bark's radius at the bone's start (bark.h) over the bone's, where that differs by more than 0.05 from 1, which is how rough
// bark is; a flare at a trunk's foot so changes none. A bone
// without Radius takes the bark's own. Branches without a ring of bark stay. Needs ends. One note.
void take_bark_radii(BarkSurface, std::vector<Bone>&, ImportNotes&);

} // namespace bough::speedtree
