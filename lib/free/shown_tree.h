// shown_tree.h: the tree that a mesh of a run with free bodies is made of.
//
// What breaks off in the run stands on its own from the start: it is a root at its joint's drawn place, so that its mesh ends there and its joint may
// leave. A piece of a branch goes on as a branch of its own. Balls follow as fruit that are roots. Bodies keep their numbers. A motion's poses are in
// the world, so they fit this tree as they fit the original. O(n).
#pragma once
#include "../model/scene.h"

namespace bough {

Tree shown_tree(const Tree&, const std::vector<std::uint32_t>& broken, const std::vector<Ball>&);

} // namespace bough
