// coupled_tables.h: the coupled step's table of motions (lanes.h, CoupledPlaces) as its sweeps and what is around them take it.
#pragma once
#include "lane_states.h"
#include "lane_tables.h"

namespace bough::fast {

// Of the table as it stands.
template <class T>
CoupledPlaces places_of(const CoupledLanesPlan<T>& own, const CoupledLanesState<T>& work, const Block& block) {
    return coupled_places(block, waits(own.lanes.layout), scheme_of(own.scheme).poles, work.lanes.odd);
}
// The block's part of it, for a sweep over the block.
template <class T> void place_block(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const Block&, CoupledRows<T>&);

// Where each row's motion stands in it. O(rows).
template <class T>
void motion_of_rows(const CoupledLanesPlan<T>&, const CoupledLanesState<T>&, std::vector<std::size_t>& at);

// The wind over the ground at the start and end of the step from `time` [s].
template <class T> void place_field_change(const Plan<T>&, CoupledLanesState<T>&, double time, CoupledRows<T>&);

// Every row's stiffness and damping times these.
template <class T> void scale_wood(PlannedLanes<T>&, T stiffness, T damping);

} // namespace bough::fast
