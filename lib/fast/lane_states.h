// lane_states.h: what the two solvers have beside plan and state where their steps are made in lanes.
#pragma once
#include "../analytic/analytic_state.h"
#include "../coupled/coupled_state.h"
#include "lanes.h"

namespace bough::fast {

// The constants of CoupledPlan stand in rows once the layout does; its arrays are then empty.
template <class T> struct CoupledLanesPlan : CoupledPlan<T> { PlannedLanes<T> lanes; };
template <class T> struct CoupledLanesState : Cloned<CoupledLanesState<T>, CoupledState<T>, StepperState> {
    Lanes<T> lanes;
    std::size_t bytes() const override {
        return (this->theta_change.capacity() + this->theta_dot_change.capacity()) * sizeof(Vector3<T>) + lanes.bytes();
    }
};

// Likewise; the factors of inertia stay where somebody reads poses.
template <class T> struct AnalyticLanesPlan : AnalyticPlan<T> { PlannedLanes<T> lanes; };
template <class T> struct AnalyticLanesState : Cloned<AnalyticLanesState<T>, AnalyticState<T>, StepperState> {
    Lanes<T> lanes;
    std::size_t bytes() const override { return this->scaled_rate.capacity() * sizeof(Vector3<T>) + lanes.bytes(); }
};

} // namespace bough::fast
