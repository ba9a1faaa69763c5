// clear_lanes.h: pads, and bodies that become such because they broke off their tree (free/fracture.h).
//
// A pad, a body that is none, goes with its parent and hands on as good as nothing; what constants it has is the step's own affair. Nothing
// bends it, and its motion, which no saved state holds, stays 0.
#pragma once
#include "lane_memory.h"
#include "lanes.h"

namespace bough::fast {

// Makes the bodies' lanes pads at rest. rows, motion_at: the motions, and where each row's stands in them; constants, motions: quantities of each; pad: puts a pad's constants that are not zero.
// The rows share no constants (shared_constants.h). O(bodies).
template <class T>
void clear_lanes(PlannedLanes<T>&, RowVector<T>& rows, const std::vector<std::size_t>& motion_at, int constants,
                 int motions, void (*pad)(const Slot<T>&), const std::vector<std::size_t>& bodies);

} // namespace bough::fast
