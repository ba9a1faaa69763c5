// analytic_rows.h: what the analytic step's sweeps over lanes (analytic_sweeps.h) read and write: the place of each quantity in a row, and all that a
// sweep is given (sweep_rows.h).
//
// Everything of a body is in the axes of that body, its composite too. What goes inward is turned once into the parent's axes. No body's inertia is
// turned into the world's axes and back, as in the plain step (composite.h).
#pragma once
#include "../lanes/sweep_rows.h"

namespace bough::fast::analytic {

// What changes from step to step and is carried: State's arrays of these names. They change in place, as a joint reads no other joint's.
namespace motion {
enum : int { theta = 0, scaled_rate = 3, theta_dot = 6, count = 9 };
}

// Constants of a body.
namespace constant {
using namespace body_constant;
enum : int {
    bend = shared_count, // [1] square roots of the factors of inertia (joint.h): across the branch, and about it
    twist = 22,
    gravity_row = 23, // [N m]
    still_count = 24, // without wind these are all
    sway = 24,        // [1]
    joint_distance = 25,
    com_distance = 26, // [m]
    inverse_weight = 27,
    drag_area = 28, // [kg/m]
    count = 29
};
} // namespace constant
constexpr int constants(bool wind) {
    return wind ? int(constant::count) : int(constant::still_count);
}

// Goes from the sweep outward to the sweep inward and to the joint's own step, in a thread's own memory.
namespace loaded {
enum : int {
    R_pb = 0, // parent's body frame from body; inward, then, J (6) and h (3) of the composite
    J = 0,    // [kg m^2] symmetric
    h = 6,    // [kg m]
    f = 9,    // [N] of pulls, and of the wind on the body at rest
    tau = 12, // [N m about own joint]; inward, then, of the composite
    drag_f =
        15, // [N] what the body's velocity changes of the wind's force; inward, then, its moment [N m] on the composite
    drag = 18, // [N s/m] the three bounds of external_forces.h; inward, then, their rows (drag.h)
    wind = 19,
    turn = 20,
    g = 21, // [m/s^2]
    count = 24
};
}

// Stands behind a block's rows of those, where the scene has /leaves: [N m] how a leaf's velocity changes the air's torque.
constexpr int leaf_torque_count = 3;

// Goes between chains, a record a joint.
namespace outward {
enum : int {
    R_bw = 0,  // body frame from world
    omega = 9, // [rad/s]
    v = 12,    // [m/s] of the body's joint
    y = 15,    // [m] its height
    count = 16,
    x = 16, // [m] where the wind varies over the ground
    z = 17,
    field_count = 18
};
}
constexpr int outward_count(bool field) {
    return field ? int(outward::field_count) : int(outward::count);
}
// In the parent's axes, about the parent's joint.
namespace inward {
enum : int {
    h = 0,
    J = 3,
    mass = 9,
    unloaded_count = 10, // without forces
    f = 10,
    tau = 13,
    airless_count = 16, // without wind
    drag_f = 16,
    drag_tau = 19,
    drag = 22,
    drag_row = 23,
    wind = 24,
    wind_row = 25,
    turn = 26,
    turn_row = 27,
    count = 28
};
}
constexpr int inward_count(bool wind, bool pulls) {
    return wind ? int(inward::count) : pulls ? int(inward::airless_count) : int(inward::unloaded_count);
}

} // namespace bough::fast::analytic

namespace bough::fast {

template <class T> struct AnalyticRows : SweepRows<T> {
    T* motion;
    bool (*shorten)(T* theta); // shorten_rotation (math.h) for one body
};

} // namespace bough::fast
