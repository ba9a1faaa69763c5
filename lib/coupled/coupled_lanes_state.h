// coupled_lanes_state.h: what the coupled solver has beside plan and state where its steps are made in lanes.
#pragma once
#include "../lanes/lanes.h"
#include "coupled_state.h"

namespace bough::fast {

// The constants of CoupledPlan stand in rows once the layout does; its arrays are then empty.
template <class T> struct CoupledLanesPlan : CoupledPlan<T> { PlannedLanes<T> lanes; };
template <class T> struct CoupledLanesState : Cloned<CoupledLanesState<T>, CoupledState<T>, StepperState> {
    Lanes<T> lanes;
    std::size_t bytes() const override {
        return (this->theta_change.capacity() + this->theta_dot_change.capacity()) * sizeof(Vector3<T>) + lanes.bytes();
    }
};

} // namespace bough::fast
