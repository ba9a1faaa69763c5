// clear_lanes.h: pads, and bodies that become pads because they broke off their tree (free/fracture.h).
//
// A pad is a lane without a body. It goes with its parent and hands on as good as nothing. The step decides which constants it has. Nothing bends it,
// and its motion, which no saved state holds, stays 0.
#pragma once
#include "lane_memory.h"
#include "lanes.h"

namespace bough::fast {

// Makes the bodies' lanes pads at rest. rows: the motions. motion_at: where each row's motion stands in them. constants, motions: how many quantities
// each has. pad: puts a pad's constants that are not zero. The rows must share no constants (shared_constants.h). O(bodies).
template <class T>
void clear_lanes(PlannedLanes<T>&, RowVector<T>& rows, const std::vector<std::size_t>& motion_at, int constants,
                 int motions, void (*pad)(const Slot<T>&), const std::vector<std::size_t>& bodies);

} // namespace bough::fast
