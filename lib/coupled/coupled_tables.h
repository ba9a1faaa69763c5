// coupled_tables.h: the coupled step's table of motions (coupled_places.h) as its sweeps and what is around them take it.
#pragma once
#include "../lanes/lane_tables.h"
#include "coupled_lanes_state.h"
#include "coupled_places.h"

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

// The last step's changes, of the motions as they stand, times ratio.
template <class T> void scale_changes(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, T ratio);

// Constants of a lane without a body (clear_lanes.h): no mass, no inertia, a spring never bent. All others of it are zero.
template <class T> void put_pad(const Slot<T>&);

// [bytes] of the cache that cores share on the machines of these years, at least: what is larger goes through memory in any case.
constexpr std::size_t shared_cache = std::size_t(32) << 20;

// Whether `solved` of a layout is more than shared_cache, and is written past the caches where the target can.
// Measured (Xeon, 480 MB shared; coupled, float, gusty wind; streamed over not): 10k bodies, 2.8 MB: 1.24; 100k, 24 MB: 1.08; 1M, 230 MB: 0.69.
bool streams(const Layout&);

} // namespace bough::fast
