// motion.h: what a simulation gives: a header, then one frame after another. Bodies stand in document order.
#pragma once
#include "../base/math.h"
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bough {

// Which arrays a frame carries. An array that is not wanted is neither computed for output nor written.
struct MotionFields {
    bool pose = true;      // position, rotation
    bool velocity = false; // velocity (of the centre of mass), angular_velocity
    bool torque = false;   // torque
    bool angles = false;   // theta, theta_dot
    bool stress = false;   // stress
};

// What happened in the steps that led to a frame, as arrays over events. Bodies are numbered as in the motion: the trees', then balls, then walkers.
struct MotionEvents {
    // broke   The joint of `body` broke. value: its spring's torque [N m].
    // hit     `body`, a ball or the body whose joint broke, met `on` (-1: the ground). value: the impulse [N s].
    // landed  `body`, a leaf or petal, came to the ground, or a walker came to the body `on`. value: its speed [m/s].
    // leapt   `body`, a walker, left the body `on`. value: its speed [m/s].
    std::vector<std::string> what;
    std::vector<std::int32_t> body, on; // on: -1 where there is none
    std::vector<double> value;

    void add(const char* event, std::int64_t of, std::int64_t other, double number) {
        what.push_back(event);
        body.push_back(std::int32_t(of));
        on.push_back(std::int32_t(other));
        value.push_back(number);
    }
};

struct MotionHeader {
    double fps = 30;
    std::int64_t bodies = 0; // of the trees, the balls and walkers
    std::int64_t balls = 0;  // how many of them, the last ones
    bool events = false;     // frames list what broke, hit, landed and leapt
    // For a motion that is part of another: which part, of how many, and the index of its first body in the whole.
    std::int32_t part = 1, parts = 1;
    std::int64_t first_body = 0;
    std::string whole; // 16 hexadecimal digits, the same in all parts of one run
    MotionFields fields;
    std::string name;   // the tree's
    std::string source; // command lines that made it
};

struct MotionFrame {
    std::int64_t frame = 0;
    double time = 0;                    // [s]
    std::vector<Vec3> position;         // [m] own joint of each body, world
    std::vector<Quat> rotation;         // world from body, x y z w in files
    std::vector<Vec3> velocity;         // [m/s] of the centre of mass, world
    std::vector<Vec3> angular_velocity; // [rad/s] world
    std::vector<Vec3> torque;           // [N m] of the joint's spring and damper on the body, joint frame
    std::vector<Vec3> theta;            // [rad] joint frame
    std::vector<Vec3> theta_dot;        // [rad/s] joint frame
    std::vector<double> stress; // [Pa] that bends the wood at the joint (bending_stress.h); 0 of all but branches
    MotionEvents events;
};

struct Motion {
    MotionHeader header;
    std::vector<MotionFrame> frame;
};

// A run's state between two frames, enough for the run to go on as if it had not been cut: `treesim --save-state`, `--resume`.
struct SavedState {
    std::int64_t frame = 0; // the last frame that was made
    double fps = 30;
    std::int32_t substeps = 1;
    std::string precision;            // "float" or "double"
    std::string solver;               // "analytic" ...
    std::string scheme;               // "P12" ..., of the coupled solver; empty with all others
    std::uint64_t fingerprint = 0;    // of the tree and the scene it belongs to
    std::int32_t part = 1, parts = 1; // of a scene's trees (MotionHeader)
    std::string whole;
    std::vector<Vec3> theta;     // [rad]; floats are exact in doubles
    std::vector<Vec3> theta_dot; // [rad/s]
    // What else a solver carries from step to step. Each solver fills in its own arrays; the others stay empty.
    std::vector<Vec3> theta_change, theta_dot_change; // coupled: [rad], [rad/s] of the last step
    std::vector<Vec3> scaled_rate;                    // analytic: AnalyticState::scaled_rate [sqrt(J)]
    std::vector<Vec3> spin_dot;                       // analytic with lagged fictitious terms [rad/s^2]
    double articulated_step = 0;                      // articulated: [s] its inner step
    std::vector<double> free_bodies;                  // saved_world of free/world.h; empty where nothing is free
    std::vector<double> sleep;                        // saved_sleep of coupled/sleep.h; empty where nothing has settled
    std::vector<double> attachments;                  // saved_attachments of plan/attachment_course.h; empty without
    // If the run changed its step: how many steps it had taken by then, and the time [s]. Else empty.
    std::vector<double> step_change;
    std::string source;
};

struct Defect; // splines.h

// Returns the first broken rule that needs no run to see, or none: numbers are finite, names short and of ASCII,
// and counts, precision and step_change as said above. O(bodies).
std::optional<Defect> check(const SavedState&);

} // namespace bough
