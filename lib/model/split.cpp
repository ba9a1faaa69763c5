#include "split.h"
#include <algorithm>

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
    if (!from.leaf_facing.empty()) to.leaf_facing.push_back(from.leaf_facing[i]);
    if (!from.drag.empty()) to.drag.push_back(from.drag[i]);
}

} // namespace

Tree part_of(const Tree& tree, const std::vector<std::int32_t>& bodies) {
    Tree part;
    part.name = tree.name;
    part.material = tree.material;
    part.source = tree.source;
    part.color = tree.color;
    for (const std::int32_t i : bodies) {
        const auto p = std::lower_bound(bodies.begin(), bodies.end(), tree.parent[std::size_t(i)]);
        const bool is_there = p != bodies.end() && *p == tree.parent[std::size_t(i)];
        copy_body(part, tree, std::size_t(i), is_there ? std::int32_t(p - bodies.begin()) : -1);
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
