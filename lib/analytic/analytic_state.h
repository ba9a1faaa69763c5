// analytic_state.h: the analytic solver's own part of plan and state: constants, what it carries from step to step, what a step works in.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"
#include "held_state.h"

namespace bough {

template <class T> struct AnalyticPlan {
    bool fictitious = false; // lagged terms of the joints' own motion (fictitious.h)

    std::vector<Vector3<T>> inertia_factor; // [1] square roots of F's diagonal (spring.h)

    // Gravity's gradient (spring.h).
    std::vector<T> gravity_row; // [N m] bound on what the path's other joints change of gravity's moment
    T row_gravity = 0; // [m/s^2] what the rows hold for: |g|, or 1 where the root's motion stands in (root_term.h)

    // Bounds on the air's (drag.h); with wind.
    std::vector<T> sway;                         // [1] W_b: what the weights move the body's centre of mass by
    std::vector<T> joint_distance, com_distance; // [m] |joint_position|, |com|
    std::vector<T> inverse_weight;               // [m/rad] 1 / u_j
};

// What a moving ground does to the joints on it in one step (root_term.h), in world axes as at the step's start.
template <class T> struct RootLoad {
    Vector3<T> x;            // [m] where the pivot of the ground's turning is
    Vector3<T> g;            // [m/s^2] gravity less that point's acceleration
    Vector3<T> omega, alpha; // [rad/s], [rad/s^2]
};

// The part of the state that is the same whether the step is made plainly or in lanes.
template <class T> struct AnalyticState : StepperState {
    // [sqrt(J)] L^T times the rates J theta_dot, S = L L^T (spring.h); carried, saved
    std::vector<Vector3<T>> scaled_rate;
};

// The plain step's part: arrays over bodies.
template <class T> struct AnalyticWork : Cloned<AnalyticWork<T>, AnalyticState<T>, StepperState> {
    // external_forces
    std::vector<Vector3<T>> f_w, tau_w; // [N], [N m about own joint] at rest: pulls, wind on bodies that stand still
    std::vector<Vector3<T>> drag_f_w, drag_tau_w; // what the bodies' velocities change of the wind's force
    std::vector<T> drag_bound;                    // [N s/m] bound on the drag's change with the body's velocity
    std::vector<T> wind_bound;                    // [N s/m] how the force at rest falls with the body's velocity
    std::vector<T> turn_bound;                    // [N] bound on the wind's change with the body's direction, a radian

    // composite
    std::vector<Vector3<T>> c_h_w;          // [kg m] first moment of the composite about own joint
    std::vector<Matrix3<T>> c_J_w;          // [kg m^2] inertia of the composite about own joint
    std::vector<Vector3<T>> c_f_w, c_tau_w; // (3), (4)
    std::vector<Vector3<T>> c_drag_f_w, c_drag_tau_w;
    std::vector<T> c_drag, c_drag_row; // [N s/m], [N s] sums of the row-sum bounds (drag.h)
    std::vector<T> c_wind, c_wind_row;
    std::vector<T> c_turn, c_turn_row; // [N], [N m] sums of turn_bound

    // root motion, one each for the plan's splines
    std::vector<RootLoad<T>> root_load; // of the last step

    // fictitious: with AnalyticPlan::fictitious
    // [rad/s^2] how the joint's own rate J theta_dot changed at the last step's end, body axes; carried, saved
    std::vector<Vector3<T>> spin_dot;
    std::vector<Vector3<T>> alpha_w, a_w; // [rad/s^2], [m/s^2] of the body, of its own joint, by (9) and (12)
    std::vector<Vector3<T>> fictitious_w; // [N m] about own joint, for the spring

    // held_points: with attachments
    std::vector<Vector3<T>> held_tau_w; // [N m] about own joint
    std::vector<T> held_row;            // [N m/rad]
    HeldPoints<T> held;

    std::size_t bytes() const override;
};

// The part of a scene that an array of AnalyticWork is for.
enum class AnalyticNeed : std::uint8_t { always, forces, air, lagged, held };

// Does the scene have it?
template <class T> bool needs_array(const Plan<T>& plan, bool lagged, AnalyticNeed need) {
    switch (need) {
    case AnalyticNeed::forces:
        return plan.forces;
    case AnalyticNeed::air:
        return plan.wind;
    case AnalyticNeed::lagged:
        return lagged;
    case AnalyticNeed::held:
        return !plan.attachments.empty();
    case AnalyticNeed::always:
        break;
    }
    return true;
}

// Calls visit(name, array, need) for every array over bodies, in the order in which they are written.
template <class WorkType, class Visit> void visit_arrays(WorkType& w, Visit&& visit) {
    using Need = AnalyticNeed;
    visit("f_w", w.f_w, Need::forces);
    visit("tau_w", w.tau_w, Need::forces);
    visit("drag_f_w", w.drag_f_w, Need::air);
    visit("drag_tau_w", w.drag_tau_w, Need::air);
    visit("drag_bound", w.drag_bound, Need::air);
    visit("wind_bound", w.wind_bound, Need::air);
    visit("turn_bound", w.turn_bound, Need::air);
    visit("c_h_w", w.c_h_w, Need::always);
    visit("c_J_w", w.c_J_w, Need::always);
    visit("c_f_w", w.c_f_w, Need::forces);
    visit("c_tau_w", w.c_tau_w, Need::forces);
    visit("c_drag_f_w", w.c_drag_f_w, Need::air);
    visit("c_drag_tau_w", w.c_drag_tau_w, Need::air);
    visit("c_drag", w.c_drag, Need::air);
    visit("c_drag_row", w.c_drag_row, Need::air);
    visit("c_wind", w.c_wind, Need::air);
    visit("c_wind_row", w.c_wind_row, Need::air);
    visit("c_turn", w.c_turn, Need::air);
    visit("c_turn_row", w.c_turn_row, Need::air);
    visit("spin_dot", w.spin_dot, Need::lagged);
    visit("alpha_w", w.alpha_w, Need::lagged);
    visit("a_w", w.a_w, Need::lagged);
    visit("fictitious_w", w.fictitious_w, Need::lagged);
    visit("held_tau_w", w.held_tau_w, Need::held);
    visit("held_row", w.held_row, Need::held);
}

} // namespace bough
