#include "subtree.h"
#include "shape.h"
#include <algorithm>
#include <cmath>

namespace bough {

Subtrees make_subtrees(const Tree& tree, bool with_reach) {
    const std::size_t n = tree.size_bodies();
    Subtrees out;
    out.first_child.assign(n + 2, 0);
    for (std::size_t i = 0; i < n; ++i) {
        if (tree.parent[i] < 0)
            out.roots.push_back(std::uint32_t(i));
        else
            ++out.first_child[std::size_t(tree.parent[i]) + 2];
    }
    for (std::size_t i = 2; i < n + 2; ++i) out.first_child[i] += out.first_child[i - 1];
    out.child.resize(n - out.roots.size());
    for (std::size_t i = 0; i < n; ++i)
        if (tree.parent[i] >= 0) out.child[out.first_child[std::size_t(tree.parent[i]) + 1]++] = std::uint32_t(i);
    out.first_child.pop_back();
    if (!with_reach) return out;
    std::vector<double> reach(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Capsule c = capsule_of(tree.kind[i], tree.size[i]);
        reach[i] = std::max(c.a.norm() + c.radius_a, c.b.norm() + c.radius_b);
    }
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0) continue;
        double& parents = reach[std::size_t(tree.parent[i])];
        parents = std::max(parents, tree.joint_position[i].norm() + reach[i]);
    }
    out.reach.reserve(n);
    for (const double r : reach) out.reach.push_back(std::nextafter(float(r), INFINITY));
    return out;
}

} // namespace bough
