// body_poses.h: where all bodies of a state are, in double and as seen from their trees' ground: being carried is no motion of
// a tree's own.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"

namespace bough {

struct BodyPoses {
    std::vector<Vec3> x;     // [m] own joints
    std::vector<Mat3> R;     // ground from body
    std::vector<Vec3> theta; // [rad] joint axes
    std::vector<Vec3> v;     // [m/s] of the far ends; empty where the ground moves
};

// The state's kinematics are up to date (present). O(n log moved trees).
template <class T> BodyPoses body_poses(const Plan<T>&, const State<T>&, const Tree&);

} // namespace bough
