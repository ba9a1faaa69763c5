#include "split.h"
#include "tree_arrays.h"
#include <algorithm>

namespace bough {

Tree part_of(const Tree& tree, const std::vector<std::int32_t>& bodies) {
    Tree part = bodies_of(tree, bodies);
    for (std::int32_t& parent : part.parent) {
        const auto p = std::lower_bound(bodies.begin(), bodies.end(), parent);
        parent = p != bodies.end() && *p == parent ? std::int32_t(p - bodies.begin()) : -1;
    }
    return part;
}

std::vector<Tree> split_roots(const Tree& tree) {
    std::vector<std::vector<std::int32_t>> bodies; // of each root
    std::vector<std::size_t> root(tree.size_bodies());
    for (std::size_t i = 0; i < root.size(); ++i) {
        const bool is_root = tree.parent[i] < 0;
        if (is_root) bodies.emplace_back();
        root[i] = is_root ? bodies.size() - 1 : root[std::size_t(tree.parent[i])];
        bodies[root[i]].push_back(std::int32_t(i));
    }
    std::vector<Tree> trees;
    for (const auto& own : bodies) trees.push_back(part_of(tree, own));
    return trees;
}

} // namespace bough
