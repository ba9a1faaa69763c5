// tips.h: where a tree's branches end.
#pragma once
#include "tree.h"

namespace bough {

// Returns the branches' tips: pieces that no piece continues or leaves. The tip is the piece's far end (its length along z). Leaves and fruit are not
// tips: what flutters at the end of a twig is chaotic, and no error of the tree.
std::vector<std::size_t> tip_bodies(const Tree&);

} // namespace bough
