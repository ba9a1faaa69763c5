// subtree.h: which bodies hang on which, outward, and how far a subtree reaches (§6).
//
//   reach_p = max(eta_p, max over children c of |d_c| + reach_c)
// eta_p is the body's farthest point from its joint, radius included; d_c is the child's joint from the parent's. The reach is constant: what breaks
// off only makes it less. Cost: 12 bytes a body, made once, O(n).
#pragma once
#include "../model/tree.h"

namespace bough {

struct Subtrees {
    std::vector<std::uint32_t> first_child; // in `child`, one more at the end
    std::vector<std::uint32_t> child;       // rising in each
    std::vector<std::uint32_t> roots;
    std::vector<float> reach; // [m] rounded up; empty where nothing can be hit
};

Subtrees make_subtrees(const Tree&, bool with_reach);

// Calls visit(body) for `body` and all outboard of it, parents before children. Where visit returns false, what is outboard of that body is left out.
template <class Visit>
void visit_subtree(const Subtrees& trees, std::size_t body, std::vector<std::uint32_t>& stack, Visit&& visit) {
    stack.assign(1, std::uint32_t(body));
    while (!stack.empty()) {
        const std::uint32_t i = stack.back();
        stack.pop_back();
        if (!visit(std::size_t(i))) continue;
        for (std::uint32_t k = trees.first_child[i + 1]; k-- > trees.first_child[i];) stack.push_back(trees.child[k]);
    }
}

} // namespace bough
