#include "shown_tree.h"
#include "../model/drawn_pose.h"
#include <algorithm>

namespace bough {

Tree shown_tree(const Tree& tree, const std::vector<std::uint32_t>& broken, const std::vector<Ball>& balls) {
    const auto [R_wb, x_w] = broken.empty() ? DrawnPose() : drawn_pose(tree);
    Tree out = tree;
    std::int32_t next_branch = 1 + *std::max_element(tree.branch.begin(), tree.branch.end());
    std::vector<std::uint8_t> cut(tree.size_bodies(), 0);
    for (const std::uint32_t i : broken) cut[i] = 1;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (continues_parent(tree, i)) {
            const auto p = std::size_t(tree.parent[i]);
            out.branch[i] = cut[i] ? next_branch++ : out.branch[p];
        }
        if (!cut[i]) continue;
        out.parent[i] = -1;
        out.joint_position[i] = x_w[i];
        out.joint_rotation[i] = Quat(R_wb[i]).normalized();
    }
    const std::size_t first = tree.size_bodies();
    out.resize(first + balls.size());
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const std::size_t i = first + k;
        const double r = balls[k].radius;
        out.parent[i] = -1;
        out.kind[i] = Kind::fruit;
        out.mass[i] = balls[k].mass;
        out.com[i] = Vec3::Zero();
        out.inertia[i] = 0.4 * balls[k].mass * r * r * Mat3::Identity();
        out.joint_position[i] = balls[k].position;
        out.joint_rotation[i] = Quat::Identity();
        out.stiffness[i] = Vec3::Zero();
        out.damping[i] = 0;
        out.size[i] = Vec3(0, r, r);
        out.branch[i] = next_branch++;
        out.level[i] = 0;
        out.s[i] = 0;
    }
    return out;
}

} // namespace bough
