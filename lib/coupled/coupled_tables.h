// coupled_tables.h: the coupled step's table of motions (coupled_places.h) as its sweeps and the code around them use it.
#pragma once
#include "../lanes/lane_tables.h"
#include "coupled_lanes_state.h"
#include "coupled_places.h"

namespace bough::fast {

// Returns the block's places in the table as it stands.
template <class T>
CoupledPlaces places_of(const CoupledLanesPlan<T>& own, const CoupledLanesState<T>& work, const Block& block) {
    return coupled_places(block, waits(own.lanes.layout), scheme_of(own.scheme).poles, work.lanes.odd);
}
// Points the rows of a sweep at the block's part of the table.
template <class T> void place_block(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const Block&, CoupledRows<T>&);

// Finds where each row's motion stands in the table. O(rows).
template <class T>
void motion_of_rows(const CoupledLanesPlan<T>&, const CoupledLanesState<T>&, std::vector<std::size_t>& at);

// Places the wind over the ground at the start and end of the step from `time` [s].
template <class T> void place_field_change(const Plan<T>&, CoupledLanesState<T>&, double time, CoupledRows<T>&);

// Multiplies every row's stiffness and damping by these.
template <class T> void scale_wood(PlannedLanes<T>&, T stiffness, T damping);

// Multiplies the last step's changes, in the motions as they stand, by ratio.
template <class T> void scale_changes(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, T ratio);

// Puts the constants of a lane without a body (clear_lanes.h): no mass, no inertia, a spring that is never bent. All its other values are zero.
template <class T> void put_pad(const Slot<T>&);

// [bytes] Returns how much of the machine's last cache a run can count on: what the machine says, but within 32 to 64 MB. On large machines others
// take their share of it, and small ones were not measured.
std::size_t usable_cache();

// True if what a step goes through, table and constants, is more than `cache`. What is solved is then written past the caches, where the target can
// (avx512 alone; the arithmetic stays the same). Measured time, streamed over not, coupled, float, gusty wind: Xeon with 480 MB 10 000 bodies 1.24,
// 100 000 (42 MB) 1.08, 1 000 000 0.69; EPYC with 32 MB 10 000 1.34, 100 000 0.82.
bool streams(const Layout&, std::size_t cache = usable_cache());

} // namespace bough::fast
