// clear_lanes.h: pads, and bodies that become such because they broke off their tree (free/fracture.h).
//
// A pad, a body that is none, goes with its parent and hands on as good as nothing. In the coupled step: no mass, no inertia, a spring never bent.
// In the analytic step an inertia [kg m^2] whose eigenvalues can be found; its spring is neither soft nor stiff over any step, so that no
// kernel takes a case for it that the bodies beside it do not need. Nothing bends it, and its motion, which no saved state holds, stays 0.
#pragma once
#include "lane_memory.h"
#include "lanes.h"

namespace bough::fast {

// Constants of a lane without a body; all others of it are zero.
template <class T> void put_pad(const Slot<T>&);
template <class T> void put_analytic_pad(const Slot<T>&);

// Makes the bodies' lanes pads at rest. rows, motion_at: the motions, and where each row's stands in them; constants, motions: quantities of each.
// The rows share no constants (shared_constants.h). O(bodies).
template <class T>
void clear_lanes(PlannedLanes<T>&, RowVector<T>& rows, const std::vector<std::size_t>& motion_at, int constants,
                 int motions, void (*pad)(const Slot<T>&), const std::vector<std::size_t>& bodies);

} // namespace bough::fast
