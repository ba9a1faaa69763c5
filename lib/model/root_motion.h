// root_motion.h: the motion of the ground that a tree stands on (RootMotion, scene.h) as a smooth function of time.
//
// Displacements and rotations go through the keys by the same curve (quintic.h). So pose, velocity and acceleration are continuous everywhere, and
// the ground rests before the first key and after the last. For the rotation the curve's values are phi_k: rotation vectors in world axes relative to
// the first key's rotation, R = exp(phi) R_first. Of the many vectors for one rotation, phi_k is the nearest to the key before. So keys less than
// half a turn apart keep turning the way they go, also beyond a full turn. (A key within 1e-6 rad of a whole turn is taken as that turn, since its
// axis cannot be told.) Between keys the curve runs in phi: about one axis, the ground turns at the curve's rate. Where the axis changes much in the
// course of a whole turn, phi is a poor map, and more keys do not mend it.
// With J_l = J(-phi), J the body rates' Jacobian (math.h): omega = J_l phi', alpha = J_l phi'' + J_l' phi', exactly.
#pragma once
#include "../base/quintic.h"
#include "scene.h"
#include <optional>

namespace bough {

struct RootSpline {
    std::optional<QuinticSpline> position; // [m] displacement; absent: none
    std::optional<QuinticSpline> rotation; // [rad] phi; absent: R = 1
    Mat3 first = Mat3::Identity();         // rotation of the first key
    Vec3 pivot = Vec3::Zero();             // [m] what the rotation turns about, before the displacement
};

// Reads a checked RootMotion; pivot [m]: the tree's own place. O(keys).
RootSpline make_root_spline(const RootMotion&, const Vec3& pivot);

// A moving ground. Its point that was drawn at X is at x + R X, with velocity v + omega x (R X) and acceleration a + alpha x (R X) + omega x (omega x
// R X). All are world vectors.
struct Ground {
    Mat3 R = Mat3::Identity();
    Vec3 x = Vec3::Zero();                           // [m] where the world's origin has gone
    Vec3 v = Vec3::Zero(), a = Vec3::Zero();         // [m/s], [m/s^2] of that point
    Vec3 omega = Vec3::Zero(), alpha = Vec3::Zero(); // [rad/s], [rad/s^2]
};

// O(log keys).
Ground ground_at(const RootSpline&, double t);

// Returns an upper bound on the height [m] of a point drawn at X, over all times. O(keys).
double highest(const RootSpline&, const Vec3& X);

// Returns an upper bound on its distance [m] over the ground from the vertical through (x, z). O(keys).
double farthest(const RootSpline&, const Vec3& X, double x, double z);

// Bodies [first, first + count) and the spline that moves their ground. A scene's moved trees stand in rising order. The bodies of a tree stand
// together in the joined tree, so one entry serves all its roots and joints.
struct MovedTree {
    std::size_t first_body, bodies;
    std::size_t spline;
};
// Index of the spline under a body, -1 for a ground that rests. O(log moved trees).
std::int64_t spline_under(const std::vector<MovedTree>&, std::size_t body);

} // namespace bough
