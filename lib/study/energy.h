// energy.h: the energies that stability is audited with, and the audit itself is a test's or a tool's.
//
// kinetic    of the joints' oscillators, sum of theta_dot^T S theta_dot / 2 (joint.h): what the analytic step conserves in a
//            joint; with JointInertia::branch it is not the bodies' own. Of all other solvers: the bodies'.
// bodies     sum of m v^2 / 2 + omega^T I omega / 2 of the bodies with the velocities of (8), (11).
// elastic    sum of theta^T K theta / 2.
// potential  of gravity, sum of -m g.x, relative to x = 0.
// Reads theta, theta_dot, scaled_rate and the present ground. O(n), doubles throughout, allocates. Errors none.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"

namespace bough {

// A body at its own joint, world: rotation, place [m], velocity [m/s] and angular velocity [rad/s].
struct BodyMotion {
    Mat3 R = Mat3::Identity();
    Vec3 x = Vec3::Zero(), v = Vec3::Zero(), omega = Vec3::Zero();
};
// Of every body, from theta and theta_dot.
template <class T> std::vector<BodyMotion> body_motions(const Plan<T>&, const State<T>&);

struct Energy {
    double kinetic = 0, bodies = 0, elastic = 0, potential = 0; // [J]
};

template <class T> Energy energy(const Plan<T>&, const State<T>&);

} // namespace bough
