// articulated_pass.h: what one articulated-body pass works in (articulated.h), and what the articulated solvers have beside plan and state: a pass
// for each that one runs side by side.
#pragma once
#include "../base/math.h"
#include "../laws/wind.h"
#include "../model/root_motion.h"
#include "../plan/stepper.h"
#include <span>
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
    // [m] of Plan::attachments: where each point is at the run's start (from the other body's)
    std::span<const Vec3> attached_at;
    std::span<const Vec3> carried_drag; // of all bodies (carried.h), for implicit steps alone; empty: without its bound
    std::uint64_t fast = 0; // angular velocities that were bounded in quadratic terms, since the counter was read
};

enum class ArticulatedMethod : std::uint8_t { explicit_euler, implicit_euler, extrapolation };

struct ArticulatedPlan {
    ArticulatedMethod method = ArticulatedMethod::implicit_euler;
    double tolerance = 1e-8;        // [rad] error allowed in a step of the extrapolation (extrapolation.h)
    std::vector<Vec3> carried_drag; // [kg] carried.h; of the implicit method, with wind
};

struct ArticulatedState : Cloned<ArticulatedState, StepperState> {
    std::vector<Vec3> rate;            // [rad/s] of joints, J theta_dot; carried, saved
    std::vector<ArticulatedPass> pass; // one, or as many as rows of the extrapolation
    std::vector<Vec3> attached_at;     // [m] ArticulatedPass's
    double inner_step = 0; // [s] what the extrapolation proposes for its next inner step; 0: none yet; saved

    std::size_t bytes() const override {
        std::size_t sum = rate.capacity() * sizeof(Vec3);
        for (const ArticulatedPass& p : pass) sum += p.body.capacity() * sizeof(ArticulatedBody);
        return sum;
    }
};

} // namespace bough
