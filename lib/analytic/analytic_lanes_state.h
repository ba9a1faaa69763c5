// analytic_lanes_state.h: the analytic solver's own part of plan and state where its steps are made in lanes.
#pragma once
#include "../lanes/lanes.h"
#include "analytic_state.h"

namespace bough::fast {

// The constants of AnalyticPlan stand in rows once the layout does. Of its arrays the factors of inertia stay where somebody reads poses.
template <class T> struct AnalyticLanesPlan : AnalyticPlan<T> { PlannedLanes<T> lanes; };
template <class T> struct AnalyticLanesState : Cloned<AnalyticLanesState<T>, AnalyticState<T>, StepperState> {
    Lanes<T> lanes;
    std::size_t bytes() const override { return this->scaled_rate.capacity() * sizeof(Vector3<T>) + lanes.bytes(); }
};

} // namespace bough::fast
