// resolve_choice.h: which of a tree's bodies become one (resolve.h). Private to resolve.
#pragma once
#include "flexibility.h"

namespace bough {

// Bodies of the resolved tree, in its order: wood, then leaves, petals and clumps, then fruit, each in the order of the whole tree.
struct Resolution {
    std::vector<std::int32_t> body;  // of each body of the whole tree: that of the resolved one which it is part of
    std::vector<std::int32_t> first; // of each resolved body: its first in the whole tree
    std::vector<std::int32_t> on;    // of each: the resolved body of wood that bears it, -1: the ground
    std::vector<std::uint8_t> clump; // of each: it is a clump
    std::size_t size() const { return first.size(); }
};

// Throws as resolve().
Resolution choose_bodies(const Tree& whole, const Flexibility&, std::int64_t bodies);

} // namespace bough
