// state.h: what a step changes, with any solver. Arrays are empty where the plan leaves them out.
#pragma once
#include "../laws/wind.h"
#include "plan.h"
#include "step_flags.h"
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace bough {

// A force on a body for one step: of a contact, of a walker, or the caller's.
template <class T> struct Load {
    std::size_t body;
    Vector3<T> point_b; // [m] body frame
    Vector3<T> force;   // [N] world
};

template <class T> struct State {
    std::int64_t step = 0;       // steps taken
    std::int64_t step_since = 0; // and those of the plan's dt: from the step on at which it was changed last,
    double time_since = 0;       // [s] at this time (change.h)

    std::vector<Vector3<T>> theta, theta_dot; // [rad], [rad/s] joint frame: the state proper; hashed, saved

    // state_update
    std::vector<Matrix3<T>> R_wb;         // world from body
    std::vector<Vector3<T>> x_w;          // [m] own joint, world
    std::vector<Vector3<T>> omega_w, v_w; // [rad/s], [m/s] of the centre of mass; with wind or when asked for

    // wind_field
    WindTable<T> wind;

    std::vector<Load<T>> loads; // of the step to come; with Plan::loads

    // root motion, one each for the plan's splines
    std::vector<Ground> ground; // present

    // spring
    std::vector<Vector3<T>> torque_j; // [N m] of spring and damper on the body, joint frame; when asked for

    Copied<StepperState> own; // what the solver carries and works in

    std::array<std::uint64_t, stage_count> calls{}; // how often each stage ran
    StepFlags flags;

    // Returns the memory of all arrays over bodies, the solver's too, and of the points that are held and pulled. It leaves out what the threads of
    // a step in lanes work in, and the energy guard's memory once something has turned fast.
    std::size_t bytes() const;
};

// [s] Returns the time of the state, or of `ahead` steps later.
template <class T> double time_of(const Plan<T>& plan, const State<T>& state, double ahead = 0) {
    return state.time_since + (double(state.step - state.step_since) + ahead) * plan.dt;
}

// Returns a state at the plan's start pose, at rest, with kinematics up to date.
template <class T> State<T> make_state(const Plan<T>&);

// Called after a state was set from outside (a saved state). Brings the ground, kinematics and the rows of lanes to what theta, theta_dot, the
// solver's carried arrays and the number of steps say. O(n).
template <class T> void restart(const Plan<T>&, State<T>&);

// Takes one step with the plan's stepper. Needs a state of this plan with kinematics up to date, and leaves one. If the plan is in lanes, present()
// brings them up to date.
template <class T> void advance(const Plan<T>&, State<T>&, StageClock* clock = nullptr);

// Brings the arrays in document order up to date: theta, theta_dot and, with Plan::pose, all that depends on them. Does nothing where they already
// are.
template <class T> void present(const Plan<T>&, State<T>&);

// Returns 64 bits (FNV-1a over little-endian bytes) of theta and theta_dot in document order.
template <class T> std::uint64_t state_hash(const State<T>&);
// Returns the same of what the solver holds, which need not be presented.
template <class T> std::uint64_t state_hash(const Plan<T>&, const State<T>&);

// Returns the first body with a non-finite theta or theta_dot.
template <class T> std::optional<std::size_t> first_non_finite(const State<T>&);

} // namespace bough
