#include "place.h"

namespace bough {

void place(Tree& tree, const Vec3& position, double yaw, std::size_t first) {
    const Quat turn(Eigen::AngleAxisd(yaw, Vec3::UnitY()));
    for (std::size_t i = first; i < tree.size_bodies(); ++i) {
        if (tree.parent[i] >= 0) continue;
        tree.joint_position[i] = turn * tree.joint_position[i] + position;
        tree.joint_rotation[i] = (turn * tree.joint_rotation[i]).normalized();
    }
}

} // namespace bough
