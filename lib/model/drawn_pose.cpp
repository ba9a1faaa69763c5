#include "drawn_pose.h"

namespace bough {

DrawnPose drawn_pose(const Tree& tree) {
    const std::size_t n = tree.size_bodies();
    DrawnPose pose{std::vector<Mat3>(n), std::vector<Vec3>(n)};
    for (std::size_t i = 0; i < n; ++i) {
        const Mat3 R_pj = tree.joint_rotation[i].toRotationMatrix();
        const bool root = tree.parent[i] < 0;
        const auto p = std::size_t(root ? 0 : tree.parent[i]);
        pose.R_wb[i] = root ? R_pj : Mat3(pose.R_wb[p] * R_pj);
        pose.x_w[i] = root ? tree.joint_position[i] : Vec3(pose.x_w[p] + pose.R_wb[p] * tree.joint_position[i]);
    }
    return pose;
}

} // namespace bough
