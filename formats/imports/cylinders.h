// cylinders.h: a tree given as cylinders that name their parent cylinder, as reconstructions of laser scans do, grouped
// into branches.
//
// Cylinders were fitted one by one, so they meet neither at ends nor on axes. Where a cylinder goes on its parent, the
// parent's end is the point they share; a child that begins farther off than the parent's radius keeps its own start, and
// a straight piece bridges the gap. Where one begins a branch, its start is kept where it lies within the parent (plus its
// own radius), wherever along it; from farther off a straight piece leads to it from the nearest place of the parent's
// axis. A point has the radius of the cylinder that ends there, a branch's first one that of its first cylinder.
#pragma once
#include "imported_tree.h"

namespace bough {

struct Cylinders {
    std::vector<Vec3> start, end;     // [file unit]
    std::vector<double> radius;       // [file unit] 0: the file gives none
    std::vector<std::int32_t> parent; // index in any order, -1: none
    std::vector<std::int64_t> branch; // a child of the same branch goes on; empty: the file does not say
    std::vector<std::size_t> line;    // of the file, for messages
    std::size_t size() const { return parent.size(); }
};

// Of the children of a cylinder, those of its branch go on it, without branches those that begin within
// its radius or a quarter of its length of its end; of several the thickest, of equally thick ones (1e-6) the one with the longest way to a tip, of
// equal ones the first. A radius that the file does not give stays 0
// (pipe_rule.h fills it). Notes count the gaps and the trunks. O(cylinders), no
// recursion. Throws InputError with FILE:LINE for a cylinder that is its own ancestor.
std::vector<ImportedBranch> branches_of(Cylinders&&, const std::string& name, ImportNotes&);

} // namespace bough
