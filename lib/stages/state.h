// state.h: what a step changes, in arrays grouped by the stage that writes them. Empty where the plan leaves them out.
#pragma once
#include "../coupled/coupled_body.h"
#include "articulated_pass.h"
#include "plan.h"
#include "wind.h"
#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

namespace bough {

// What happened in the steps so far; none of it acts on the result but bounded_lambda, energy_guard and limited.
struct StepFlags {
    std::uint64_t buckling = 0;       // joint-steps in which a joint's stiffness with gravity was negative
    std::uint64_t bounded_lambda = 0; // joint-steps in which lambda was bounded
    std::uint64_t half_turns = 0;     // joint-steps in which a joint turned past half a turn (spring.h)
    std::uint64_t energy_guard = 0;   // joint-steps in which a large turn had gained energy, taken back (spring.h)
    std::uint64_t limited = 0; // joint-steps that ended on a joint limit, which the scene asks for (joint_limit.h)
    std::uint64_t fast_turns =
        0; // bodies' turns of more than a radian a step, bounded in the implicit step (articulated.h)
    std::uint64_t inner_steps = 0; // steps that articulated_reference cut the plan's into, which is no guard
    std::uint64_t asleep = 0;      // body-steps left out, in blocks at rest (fast/sleep.h)
    std::uint64_t unresolved = 0;  // of those, how many missed the tolerance at the smallest length (extrapolation.h)
};

// What a moving ground does to the joints on it in one step (root_term.h), world as at the step's start.
template <class T> struct RootLoad {
    Vector3<T> x;            // [m] where the pivot of the ground's turning is
    Vector3<T> g;            // [m/s^2] gravity less that point's acceleration
    Vector3<T> omega, alpha; // [rad/s], [rad/s^2]
};

// A force on a body for one step, by a contact.
template <class T> struct Load {
    std::size_t body;
    Vector3<T> point_b; // [m] body frame
    Vector3<T> force;   // [N] world
};

template <class T> struct State {
    std::int64_t step = 0; // steps taken; the time is step * dt

    std::vector<Vector3<T>> theta, theta_dot; // [rad], [rad/s] joint frame: the state proper; hashed, saved

    std::vector<Vector3<T>>
        scaled_rate; // what is carried of the rates J theta_dot from step to step: analytic, [sqrt(J)] L^T times them,
                     // S = L L^T (spring.h); articulated solvers, [rad/s] themselves

    // state_update
    std::vector<Matrix3<T>> R_wb;         // world from body
    std::vector<Vector3<T>> x_w;          // [m] own joint, world
    std::vector<Vector3<T>> omega_w, v_w; // [rad/s], [m/s] of the centre of mass; with wind or when asked for

    // wind_field
    WindTable<T> wind;

    // external_forces
    std::vector<Vector3<T>> f_w, tau_w; // [N], [N m about own joint] at rest: pulls, wind on bodies that stand still
    std::vector<Vector3<T>> drag_f_w, drag_tau_w; // what the bodies' velocities change of the wind's force
    std::vector<T> drag_bound;                    // [N s/m] bound on the drag's change with the body's velocity
    std::vector<T> wind_bound;                    // [N s/m] how the force at rest falls with the body's velocity
    std::vector<T> turn_bound;                    // [N] bound on the wind's change with the body's direction, a radian

    std::vector<Load<T>> loads; // of the step to come; with Plan::contact

    // composite
    std::vector<Vector3<T>> c_h_w;          // [kg m] first moment of the composite about own joint
    std::vector<Matrix3<T>> c_J_w;          // [kg m^2] inertia of the composite about own joint
    std::vector<Vector3<T>> c_f_w, c_tau_w; // (3), (4)
    std::vector<Vector3<T>> c_drag_f_w, c_drag_tau_w;
    std::vector<T> c_drag, c_drag_row; // [N s/m], [N s] sums of the row-sum bounds (drag.h)
    std::vector<T> c_wind, c_wind_row;
    std::vector<T> c_turn, c_turn_row; // [N], [N m] sums of turn_bound

    // root motion, one each for the plan's splines
    std::vector<Ground> ground;         // present
    std::vector<RootLoad<T>> root_load; // of the last step

    // fictitious: with Plan::fictitious
    std::vector<Vector3<T>>
        spin_dot; // [rad/s^2] how the joint's own rate J theta_dot changed at the last step's end, body axes; carried, saved
    std::vector<Vector3<T>> alpha_w, a_w; // [rad/s^2], [m/s^2] of the body, of its own joint, by (9) and (12)
    std::vector<Vector3<T>> fictitious_w; // [N m] about own joint, for the spring

    // spring
    std::vector<Vector3<T>> torque_j; // [N m] of spring and damper on the body, joint frame; when asked for

    // coupled
    std::vector<Vector3<T>> theta_change, theta_dot_change; // of the last step; carried, saved
    std::vector<CoupledBody<T>> coupled;
    std::vector<ResolventBody<std::complex<T>>> resolvent;
    std::vector<ResolventBody<T>> resolvent_real;
    std::vector<GuardBody<T>> guard;
    std::vector<EnergyAccount> account; // one a root
    WindTable<T> wind_change;           // [m/s] of the wind over the step
    WindField<T> wind_start, wind_end;  // where it varies over the ground: at the step's start and end
    std::vector<GroundStep<T>> coupled_ground;

    // The fast path's rows, where the plan has lanes: then these are the state proper, and the arrays above are brought up to date when
    // they are read (fast/present.h).
    fast::Lanes<T> lanes;

    // articulated solvers: a pass each, or as many as rows of the extrapolation
    std::vector<ArticulatedPass> articulated;
    double articulated_step = 0; // [s] what articulated_reference proposes for its next inner step; 0: none yet

    std::array<std::uint64_t, stage_count> calls{}; // how often each stage ran
    StepFlags flags;

    // Allocated by all arrays but what the fast path's threads work in, and its energy guard once something has turned fast.
    std::size_t bytes() const;
};

// Passes that a solver runs side by side.
constexpr std::size_t articulated_passes(Solver solver) {
    return !is_articulated(solver) ? 0 : solver == Solver::articulated_reference ? 8 : 1;
}

// At the plan's start pose, at rest, kinematics up to date.
template <class T> State<T> make_state(const Plan<T>&);

// Brings the rates' last changes, the ground, kinematics and the fast path's rows to what theta and theta_dot, their changes and the
// number of steps say: after they were set from outside (a saved state). O(n).
template <class T> void restart(const Plan<T>&, State<T>&);

// 64 bits (FNV-1a over little-endian bytes) of theta and theta_dot in document order.
template <class T> std::uint64_t state_hash(const State<T>&);
// The same of what the fast path's rows hold, where the plan has lanes: nothing need be presented.
template <class T> std::uint64_t state_hash(const Plan<T>&, const State<T>&);

// The first body with a non-finite theta or theta_dot.
template <class T> std::optional<std::size_t> first_non_finite(const State<T>&);

} // namespace bough
