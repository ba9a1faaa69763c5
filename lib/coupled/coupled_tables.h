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

// [bytes] of the machine's last cache that a run can count on: what the machine says, but for 32 to 64 MB, as on large machines others take their
// share of it, and small ones were not measured.
std::size_t usable_cache();

// Whether what a step goes through, table and constants, is more than `cache`: what is solved is then written past the caches, where the target can
// (avx512 alone; the arithmetic stays the same). Measured, streamed over not, coupled, float, gusty wind: Xeon with 480 MB 10 000 bodies 1.24, 100 000
// (42 MB) 1.08, 1 000 000 0.69; EPYC with 32 MB 10 000 1.34, 100 000 0.82.
bool streams(const Layout&, std::size_t cache = usable_cache());

} // namespace bough::fast
