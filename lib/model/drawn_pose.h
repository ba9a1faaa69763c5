// drawn_pose.h: where each body stands when drawn (theta = 0): one forward sweep of (7) and (10). O(n).
#pragma once
#include "tree.h"

namespace bough {

struct DrawnPose {
    std::vector<Mat3> R_wb; // world from body
    std::vector<Vec3> x_w;  // [m] own joint, world
    Vec3 at(std::size_t body, const Vec3& p_b) const { return x_w[body] + R_wb[body] * p_b; }
};
DrawnPose drawn_pose(const Tree&);

} // namespace bough
