// split.h: a tree of several roots (three trunks) as one tree a root.
//
// Bodies keep their order, and branch, level and s their values, so that a selector that names a branch still does.
// Reads a checked tree. O(bodies). Errors none; a tree of one root gives that tree.
#pragma once
#include "tree.h"
#include <vector>

namespace bough {

std::vector<Tree> split_roots(const Tree&);

} // namespace bough
