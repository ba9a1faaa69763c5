// coupled_lanes_state.h: the coupled solver's own part of plan and state where its steps are made in lanes.
#pragma once
#include "../lanes/lanes.h"
#include "coupled_state.h"

namespace bough::fast {

// The constants of CoupledPlan stand in rows once the layout does; its arrays are then empty.
template <class T> struct CoupledLanesPlan : CoupledPlan<T> { PlannedLanes<T> lanes; };
// What attachments add to the sweep inward (attachment_lanes.h).
template <class T> struct AttachedRows {
    // Of each row, the place of its record in `terms`, -1: none; empty without attachments
    std::vector<std::int32_t> of_row;
    RowVector<T> terms;    // as records inward, but in rows
    RowVector<T> inverses; // with ties alone: CoupledRows::inverses

    std::size_t bytes() const {
        return of_row.size() * sizeof(of_row[0]) + (terms.size() + inverses.size()) * sizeof(Row<T>);
    }
};

template <class T> struct CoupledLanesState : Cloned<CoupledLanesState<T>, CoupledState<T>, StepperState> {
    Lanes<T> lanes;
    AttachedRows<T> attached;
    std::size_t bytes() const override {
        return (this->theta_change.capacity() + this->theta_dot_change.capacity()) * sizeof(Vector3<T>) +
               lanes.bytes() + this->attachments.bytes() + attached.bytes();
    }
};

} // namespace bough::fast
