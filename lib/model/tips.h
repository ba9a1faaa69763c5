// tips.h: where a tree's branches end.
#pragma once
#include "tree.h"

namespace bough {

// The branches' tips: pieces that no piece goes on from or leaves; the point meant is the far end (its length along z). Leaves
// and fruit are not tips: what flutters at the end of a twig is chaotic, and no error of the tree.
std::vector<std::size_t> tip_bodies(const Tree&);

} // namespace bough
