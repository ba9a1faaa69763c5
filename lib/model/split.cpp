#include "split.h"

namespace bough {
namespace {

void copy_body(Tree& to, const Tree& from, std::size_t i, std::int32_t parent) {
    to.parent.push_back(parent);
    to.kind.push_back(from.kind[i]);
    to.mass.push_back(from.mass[i]);
    to.com.push_back(from.com[i]);
    to.inertia.push_back(from.inertia[i]);
    to.joint_position.push_back(from.joint_position[i]);
    to.joint_rotation.push_back(from.joint_rotation[i]);
    to.stiffness.push_back(from.stiffness[i]);
    to.damping.push_back(from.damping[i]);
    to.size.push_back(from.size[i]);
    to.branch.push_back(from.branch[i]);
    to.level.push_back(from.level[i]);
    to.s.push_back(from.s[i]);
    if (!from.rigid.empty()) to.rigid.push_back(from.rigid[i]);
    if (!from.load.empty()) to.load.push_back(from.load[i]);
    if (!from.leaf_count.empty()) to.leaf_count.push_back(from.leaf_count[i]);
    if (!from.leaf_length.empty()) to.leaf_length.push_back(from.leaf_length[i]);
    if (!from.leaf_width.empty()) to.leaf_width.push_back(from.leaf_width[i]);
    if (!from.drag.empty()) to.drag.push_back(from.drag[i]);
}

} // namespace

std::vector<Tree> split_roots(const Tree& tree) {
    const std::size_t n = tree.size_bodies();
    std::vector<Tree> trees;
    std::vector<std::size_t> root(n);   // which of the trees a body goes to
    std::vector<std::int32_t> place(n); // its index there
    for (std::size_t i = 0; i < n; ++i) {
        const bool is_root = tree.parent[i] < 0;
        const auto p = std::size_t(is_root ? 0 : tree.parent[i]);
        if (is_root) {
            trees.emplace_back();
            trees.back().name = tree.name;
            trees.back().material = tree.material;
            trees.back().source = tree.source;
            trees.back().color = tree.color;
        }
        root[i] = is_root ? trees.size() - 1 : root[p];
        Tree& own = trees[root[i]];
        place[i] = std::int32_t(own.size_bodies());
        copy_body(own, tree, i, is_root ? -1 : place[p]);
    }
    return trees;
}

} // namespace bough
