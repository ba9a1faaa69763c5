// articulated_pass.h: what one articulated-body pass works in (lib/reference/articulated.h); a State holds one for each
// pass that its solver runs side by side.
#pragma once
#include "../model/math.h"
#include "../model/root_motion.h"
#include "wind.h"
#include <vector>

namespace bough {

// One body, everything in its own axes and about its own joint unless said. The three sweeps each read and write most of
// a body's fields, so they stand together.
struct ArticulatedBody {
    Vec3 theta, rate; // [rad], [rad/s]: where the pass is made; rate = J theta_dot

    Mat3 R_wb, R_pb;         // world and parent from body
    Vec3 x_w;                // [m] own joint, world
    Vec3 omega, v;           // [rad/s], [m/s] of the body at its joint
    Vec3 alpha_bias, a_bias; // [rad/s^2], [m/s^2] accelerations where neither this joint nor the parent accelerates

    Mat3 A, B, M; // [kg m^2], [kg m], [kg] articulated inertia: N = A alpha + B a + N_0, F = B^T alpha + M a + F_0
    Vec3 N, F;    // [N m], [N] bias wrench; after the inward sweep with the biases' own
    Mat3 Z;       // [kg m^2] what the joint's own spring and damper add to an implicit step's inertia
    Mat3 E;       // (A + Z)^-1
    Vec3 u;       // [N m] joint's torque less N

    Vec3 alpha, a; // [rad/s^2], [m/s^2] of the body at its joint
    Vec3 rate_dot; // [rad/s^2] the pass' result
};

struct ArticulatedPass {
    std::vector<ArticulatedBody> body;
    WindTable<double> wind;
    std::vector<Ground> ground; // of each spline of root motion
    std::uint64_t fast = 0;     // angular velocities that were bounded in quadratic terms, since the counter was read
};

} // namespace bough
