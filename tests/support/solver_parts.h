// solver_parts.h: what the solvers keep beside plan and state, reached from plan and state whatever the solver: empty where it has none of it.
#pragma once
#include "lib/analytic/analytic_lanes_stepper.h"
#include "lib/analytic/analytic_stepper.h"
#include "lib/analytic/composite.h"
#include "lib/analytic/external_forces.h"
#include "lib/analytic/fictitious.h"
#include "lib/coupled/coupled_lanes_stepper.h"
#include "lib/coupled/coupled_stepper.h"
#include "lib/coupled/sleep.h"
#include "lib/lanes/plan_lanes.h"
#include "lib/plan/explain.h"
#include "lib/study/articulated_stepper.h"
#include "lib/study/solvers.h"

namespace parts {

using namespace bough;

// A part that is not there.
template <class Part> Part& none() {
    static Part part;
    return part = Part();
}

template <class Part, class T> Part& of(State<T>& state) {
    auto* part = dynamic_cast<Part*>(&*state.own);
    return part ? *part : none<Part>();
}
template <class Part, class T> const Part& of(const State<T>& state) {
    const auto* part = dynamic_cast<const Part*>(&*state.own);
    return part ? *part : none<Part>();
}

template <class T> auto& joints(State<T>& state) { // of the plain analytic step
    return of<AnalyticWork<T>>(state);
}
template <class T> const auto& joints(const State<T>& state) {
    return of<AnalyticWork<T>>(state);
}
template <class T> const AnalyticPlan<T>& joints(const Plan<T>& plan) {
    if (const auto* plain = dynamic_cast<const AnalyticStepper<T>*>(&*plan.stepper)) return plain->own;
    if (const auto* lanes = dynamic_cast<const fast::AnalyticLanesStepper<T>*>(&*plan.stepper)) return lanes->own;
    return none<AnalyticPlan<T>>();
}

template <class T> auto& bodies(State<T>& state) { // of the plain coupled step
    return of<CoupledWork<T>>(state);
}
template <class T> const auto& bodies(const State<T>& state) {
    return of<CoupledWork<T>>(state);
}
template <class T> const CoupledPlan<T>& bodies(const Plan<T>& plan) {
    const CoupledPlan<T>* own = fast::coupled_plan(plan);
    return own ? *own : none<CoupledPlan<T>>();
}

// Each solver's own struct has the abstract part of its two ways; here the array itself.
template <class T> std::vector<Vector3<T>>& theta_change(State<T>& state) {
    auto* own = dynamic_cast<CoupledState<T>*>(&*state.own);
    return own ? own->theta_change : none<std::vector<Vector3<T>>>();
}
template <class T> std::vector<Vector3<T>>& theta_dot_change(State<T>& state) {
    auto* own = dynamic_cast<CoupledState<T>*>(&*state.own);
    return own ? own->theta_dot_change : none<std::vector<Vector3<T>>>();
}
template <class T> std::vector<Vector3<T>>& scaled_rate(State<T>& state) {
    if (auto* own = dynamic_cast<AnalyticState<T>*>(&*state.own)) return own->scaled_rate;
    if constexpr (std::is_same_v<T, double>)
        if (auto* own = dynamic_cast<ArticulatedState*>(&*state.own)) return own->rate;
    return none<std::vector<Vector3<T>>>();
}
template <class T> const std::vector<Vector3<T>>& theta_change(const State<T>& state) {
    return theta_change(const_cast<State<T>&>(state));
}
template <class T> const std::vector<Vector3<T>>& theta_dot_change(const State<T>& state) {
    return theta_dot_change(const_cast<State<T>&>(state));
}
template <class T> const std::vector<Vector3<T>>& scaled_rate(const State<T>& state) {
    return scaled_rate(const_cast<State<T>&>(state));
}

template <class T> const fast::PlannedLanes<T>& lanes(const Plan<T>& plan) {
    const fast::PlannedLanes<T>* planned = fast::planned_lanes(plan);
    return planned ? *planned : none<fast::PlannedLanes<T>>();
}
template <class T> const fast::Lanes<T>& lanes(const State<T>& state) {
    if (const auto* bodies = dynamic_cast<const fast::CoupledLanesState<T>*>(&*state.own)) return bodies->lanes;
    if (const auto* joints = dynamic_cast<const fast::AnalyticLanesState<T>*>(&*state.own)) return joints->lanes;
    return none<fast::Lanes<T>>();
}

// visit(name, array) for every array over bodies that a state of any solver may hold; of what this one has not, empty ones.
template <class T, class Visit> void visit_held(const State<T>& s, Visit&& visit) {
    visit("theta", s.theta);
    visit("theta_dot", s.theta_dot);
    visit("scaled_rate", scaled_rate(s));
    visit("theta_change", theta_change(s));
    visit("theta_dot_change", theta_dot_change(s));
    visit("R_wb", s.R_wb);
    visit("x_w", s.x_w);
    visit("omega_w", s.omega_w);
    visit("v_w", s.v_w);
    visit_arrays(joints(s), [&](const char* name, const auto& array, AnalyticNeed) { visit(name, array); });
    visit("coupled", bodies(s).coupled);
    visit("resolvent", bodies(s).resolvent);
    visit("resolvent_real", bodies(s).resolvent_real);
    visit("guard", bodies(s).guard);
    visit("torque_j", s.torque_j);
}

// Parts of the analytic step, by plan and state.
template <class T> void external_forces(const Plan<T>& plan, State<T>& state, double time) {
    bough::external_forces(plan, joints(plan), state, joints(state), time);
}
template <class T> void composite_update(const Plan<T>& plan, State<T>& state) {
    bough::composite_update(plan, joints(plan), state, joints(state));
}
template <class T> void fictitious_torques(const Plan<T>& plan, State<T>& state) {
    bough::fictitious_torques(plan, state, joints(state));
}

// Of a run of the coupled step in lanes (coupled/sleep.h).
template <class T> std::vector<double> saved_sleep(const Plan<T>& plan, const State<T>& state) {
    const auto& stepper = dynamic_cast<const fast::CoupledLanesStepper<T>&>(*plan.stepper);
    return fast::saved_sleep(stepper.own, of<fast::CoupledLanesState<T>>(state));
}
template <class T> void restore_sleep(const Plan<T>& plan, State<T>& state, const std::vector<double>& saved) {
    const auto& stepper = dynamic_cast<const fast::CoupledLanesStepper<T>&>(*plan.stepper);
    fast::restore_sleep(stepper.own, of<fast::CoupledLanesState<T>>(state), saved);
}

// Of articulated_reference; with other solvers nothing.
inline void set_tolerance(Plan<double>& plan, double tolerance) {
    if (auto* stepper = dynamic_cast<ArticulatedStepper*>(&*plan.stepper)) stepper->own.tolerance = tolerance;
}
// What streaming holds up of a plan's bodies, where its solver has it.
inline const std::vector<Vec3>& carried_drag(const Plan<double>& plan) {
    const auto* stepper = dynamic_cast<const ArticulatedStepper*>(&*plan.stepper);
    return stepper ? stepper->own.carried_drag : bodies(plan).carried_drag;
}

} // namespace parts
