#include "append.h"
#include "place.h"
#include "tree_arrays.h"
#include <algorithm>

namespace bough {

std::size_t append(Tree& tree, const Tree& more, const Vec3& position, double yaw) {
    const std::size_t first = tree.size_bodies(), all = first + more.size_bodies();
    const std::int32_t first_branch = first == 0 ? 0 : *std::max_element(tree.branch.begin(), tree.branch.end()) + 1;
    if (first == 0) copy_labels(tree, more);
    const auto add = [&](const char*, const auto& absent, auto& to, const auto& from) {
        if constexpr (always_there<std::decay_t<decltype(absent)>>) {
            to.insert(to.end(), from.begin(), from.end());
        } else if (!to.empty() || !from.empty()) {
            to.resize(first, absent);
            to.insert(to.end(), from.begin(), from.end());
            to.resize(all, absent);
        }
    };
    each_array(add, tree, more);

    place(tree, position, yaw, first);
    for (std::size_t i = first; i < all; ++i) {
        tree.branch[i] += first_branch;
        if (tree.parent[i] >= 0) tree.parent[i] += std::int32_t(first);
    }
    return first;
}

} // namespace bough
