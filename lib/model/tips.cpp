#include "tips.h"

namespace bough {

std::vector<std::size_t> tip_bodies(const Tree& tree) {
    std::vector<bool> inner(tree.size_bodies(), false);
    for (std::size_t i = 0; i < inner.size(); ++i)
        if (tree.parent[i] >= 0 && tree.kind[i] == Kind::branch) inner[std::size_t(tree.parent[i])] = true;
    std::vector<std::size_t> tips;
    for (std::size_t i = 0; i < inner.size(); ++i)
        if (!inner[i] && tree.kind[i] == Kind::branch) tips.push_back(i);
    return tips;
}

} // namespace bough
