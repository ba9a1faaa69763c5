// start_pose.h: how a tree's joints stand when a run begins (pose.h and sag.h find it).
#pragma once
#include "../base/math.h"
#include <vector>

namespace bough {

struct StartPose {
    std::vector<Quat> joint_rotation; // parent's body frame from joint frame, rest pose
    std::vector<Vec3> theta;          // [rad]
};

} // namespace bough
