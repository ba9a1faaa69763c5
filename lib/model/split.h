// split.h: splits a tree of several roots (three trunks) into one tree a root.
//
// Bodies keep their order, and branch, level and s keep their values. So a selector that names a branch still names it. Reads a checked tree; a tree
// of one root gives that tree. O(bodies). Errors none.
#pragma once
#include "tree.h"
#include <vector>

namespace bough {

std::vector<Tree> split_roots(const Tree&);

} // namespace bough
