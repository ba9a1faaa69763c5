// sag.h: where springs of a given rest balance gravity: T^T K theta = tau(theta) for all joints at once, by Newton's method. The matrix K + gravity's
// stiffness is block-diagonal in absolute rotations except for the springs. So a step is one backward elimination and one forward substitution of 3x3
// blocks, O(n). Of a tree it reads only parent, mass, com, joint_position, stiffness (K as scaled by the scene) and branch: a plan may have freed the
// rest. World frame, SI.
#pragma once
#include "../model/tree.h"
#include "start_pose.h"
#include <optional>

namespace bough {

// Why there is no pose, and for which body.
struct NoPose {
    std::size_t body = 0;
    std::string why;
};

// Returns the rotation world from body i, turned by theta from the springs' rest. Its parent's R is known.
Mat3 frame_of(const Tree&, const std::vector<Quat>& rest, std::size_t i, const std::vector<Mat3>& R, const Vec3& theta);
// Returns the first moment that each body's own turning moves, P of coupled gravity: of its mass and of its children's composites at their joints.
std::vector<Vec3> turned_moments(const Tree&, std::vector<double> mass, const std::vector<Mat3>& R);
// Returns the moments of gravity about each joint on its composite, in P's place.
std::vector<Vec3> gravity_moments(const Tree&, std::vector<Vec3> P, const Vec3& gravity);

// Finds the sag from the pose's angles on, in at most `iterations`. Returns what is wrong, if anything: no convergence, or a branch that buckles (an
// elimination block that is not positive definite where the iteration ends). Otherwise the pose is the sag.
std::optional<NoPose> settle(const Tree&, const Vec3& gravity, StartPose&, int iterations = 500);

// Goes to near a sag that lies below the pose in energy, by Newton steps with lifted blocks, halved until the energy falls.
void descend(const Tree&, const Vec3& gravity, StartPose&);

} // namespace bough
