// attachment_state.h: attachments as the coupled solver keeps them in a state (attachment.h).
#pragma once
#include "../base/math.h"
#include <cstdint>
#include <vector>

namespace bough {

// Of one body, what attachments add to a step's solve, world axes, about its joint. Each of them times 1/s^2, 1/s, or the slope of attachment.h.
struct AttachmentSums {
    Mat3 A_stiffness, A_damping; // [N m/rad], [N m s/rad]; the first with H
    Vec3 B_stiffness, B_damping; // [N], [N s] the vector of a cross product
    double stiffness, damping;   // [N/m], [N s/m]
    Vec3 N, N_slope, N_rate;     // [N m]; N_rate [N m/s], as F_rate
    Vec3 F, F_slope, F_rate;     // [N]
    // What the masses at points would make of the moving ground's own acceleration, whose way the targets have already: times 1/s^2, 1/s, and
    // both times its slope.
    Vec3 N_ground[4], F_ground[4];
};

// Motion of a joint at a step's start, with the changes over the last step.
struct JointNow {
    Vec3 theta, eta, theta_change, eta_change;
};

// A body that is attached, or carries one that is.
struct AttachedBody {
    std::size_t body;
    std::int64_t parent; // in Attachments::bodies, -1: the ground
    Vec3 joint_position; // of the plan
    Mat3 R_pj;
    std::uint32_t slot = 0, block = 0, base = 0; // in lanes: where it stands, the chain's place in Layout::base

    JointNow now;
    // At y*, world: as in CoupledBody, own: by the joints' rates at y0 alone, v its velocity at the joint; x_start, R_start: at y0.
    Mat3 R_start, R, GJ;
    Vec3 x_start, x, turn, own, v;
    AttachmentSums sums;
    Vec3 turned, moved; // [rad], [m] over the step, in the linear model
    Vec3 spun, sped;    // [rad/s], [m/s] likewise: rates
};

struct Attached {
    std::uint64_t number; // 0: planned; else of those made while the run goes on
    std::int64_t planned; // in Plan::attachments; -1: made so
    std::size_t body;
    std::size_t at = 0; // in Attachments::bodies
    Vec3 point_b;       // [m] body frame
    double stiffness, damping;
    double from, to; // [s]
    Vec3 target;     // [m] of one at rest, or led: at the next step's start
    Vec3 goal;       // [m] where it is led, in so many steps
    int steps = 0;

    Vec3 force = Vec3::Zero(),
         spring = Vec3::Zero(); // [N] on the body at the last step's end, and the spring's own part; carried

    // Of the step.
    bool on = false;
    double k, c;                   // as they are taken
    Vec3 rho, start, velocity;     // from the joint at y*; x_0; V_0
    Vec3 from_target, to_target;   // [m] at its start and end, as seen from the ground
    Vec3 target_velocity, quicker; // [m/s] mean, and what it gains
    double work = 0;               // [J] done on the tree, by the mean of both ends' forces
};

struct Attachments {
    std::vector<Attached> all;
    std::vector<AttachedBody> bodies; // rising
    std::uint64_t numbers = 0;        // given so far

    bool any() const { return !all.empty(); }
};

} // namespace bough
