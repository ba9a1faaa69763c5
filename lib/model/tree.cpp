#include "tree.h"
#include "place.h"
#include <algorithm>

namespace bough {
namespace {

template <class T> void add(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

// Arrays that may be empty: `absent` everywhere, then.
template <class T>
void add(std::vector<T>& to, const std::vector<T>& from, std::size_t before, std::size_t more, T absent) {
    if (to.empty() && from.empty()) return;
    to.resize(before, absent);
    add(to, from);
    to.resize(before + more, absent);
}

} // namespace

void Tree::resize(std::size_t bodies) {
    parent.resize(bodies);
    kind.resize(bodies);
    mass.resize(bodies);
    com.resize(bodies);
    inertia.resize(bodies);
    joint_position.resize(bodies);
    joint_rotation.resize(bodies);
    stiffness.resize(bodies);
    damping.resize(bodies);
    size.resize(bodies);
    branch.resize(bodies);
    level.resize(bodies);
    s.resize(bodies);
    if (!rigid.empty()) rigid.resize(bodies);
    if (!load.empty()) load.resize(bodies);
    if (!leaf_count.empty()) leaf_count.resize(bodies, 1);
    if (!leaf_length.empty()) leaf_length.resize(bodies, 0);
    if (!leaf_width.empty()) leaf_width.resize(bodies, 0);
    if (!leaf_facing.empty()) leaf_facing.resize(bodies, 0);
    if (!drag.empty()) drag.resize(bodies, 1);
}

std::size_t append(Tree& tree, const Tree& more, const Vec3& position, double yaw) {
    const std::size_t first = tree.size_bodies();
    const std::int32_t first_branch = first == 0 ? 0 : *std::max_element(tree.branch.begin(), tree.branch.end()) + 1;
    if (first == 0) {
        tree.name = more.name;
        tree.material = more.material;
        tree.source = more.source;
        tree.color = more.color;
    }
    add(tree.parent, more.parent);
    add(tree.kind, more.kind);
    add(tree.mass, more.mass);
    add(tree.com, more.com);
    add(tree.inertia, more.inertia);
    add(tree.joint_position, more.joint_position);
    add(tree.joint_rotation, more.joint_rotation);
    add(tree.stiffness, more.stiffness);
    add(tree.damping, more.damping);
    add(tree.size, more.size);
    add(tree.branch, more.branch);
    add(tree.level, more.level);
    add(tree.s, more.s);
    add(tree.rigid, more.rigid, first, more.size_bodies(), std::uint8_t(0));
    add(tree.load, more.load, first, more.size_bodies(), 0.0);
    add(tree.leaf_count, more.leaf_count, first, more.size_bodies(), 1);
    add(tree.leaf_length, more.leaf_length, first, more.size_bodies(), 0.0);
    add(tree.leaf_width, more.leaf_width, first, more.size_bodies(), 0.0);
    add(tree.leaf_facing, more.leaf_facing, first, more.size_bodies(), 0.0);
    add(tree.drag, more.drag, first, more.size_bodies(), 1.0);

    place(tree, position, yaw, first);
    for (std::size_t i = first; i < tree.size_bodies(); ++i) {
        tree.branch[i] += first_branch;
        if (tree.parent[i] >= 0) tree.parent[i] += std::int32_t(first);
    }
    return first;
}

} // namespace bough
