// skeleton.h: a tree given as nodes that name their parent node (SWC, tree files of laser scans), grouped into branches.
#pragma once
#include "imported_tree.h"

namespace bough {

struct Skeleton {
    std::vector<std::int32_t> parent; // node index in any order, -1: a root, which is a point without a segment
    std::vector<Vec3> point;          // [file unit] end of the segment that comes from the parent
    std::vector<double> radius;       // [file unit] at that point; of a root: negative where the file has none of use
    std::vector<std::size_t> line;    // of the file, for messages; may be empty where no node can be its own ancestor
    std::vector<char> loose; // may be empty: none. A loose node begins a branch of its parent's at its own place:
                             // there is no segment between the two
};

// Branches of the skeleton. A node at the place of its parent joins it. Each segment that leaves a root begins a trunk;
// at every other fork the thickest child goes on (radii equal to 1e-6: the one with the longest way to a tip; equal
// again: the straightest), the others begin branches there. A trunk begins with its root's radius if that is of use;
// a loose node's branch with
// that node's; every other branch with the radius of its own first segment. O(nodes), no recursion.
// Throws InputError with FILE:LINE for a node that is its own ancestor. Notes count joined nodes and roots left alone.
std::vector<ImportedBranch> branches_of(Skeleton&&, const std::string& name, ImportNotes&);

} // namespace bough
