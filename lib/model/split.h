// split.h: parts of a tree as trees of their own.
//
// Bodies keep their order, and branch, level and s keep their values. So a selector that names a branch still names it. Reads a checked tree. Errors
// none.
#pragma once
#include "tree.h"
#include <cstdint>
#include <vector>

namespace bough {

// The tree of these bodies, whose numbers rise. A body whose parent is not among them becomes a root. O(bodies log bodies).
Tree part_of(const Tree&, const std::vector<std::int32_t>& bodies);

// Splits a tree of several roots (three trunks) into one tree a root; a tree of one root gives that tree. O(bodies log bodies).
std::vector<Tree> split_roots(const Tree&);

} // namespace bough
