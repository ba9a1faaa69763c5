// plan_lanes.h: the layout of a plan's bodies in rows of lanes, and what any step in lanes reads of the plan in rows. O(n log n).
#pragma once
#include "../plan/plan.h"
#include "lanes.h"

namespace bough::fast {

// Fills in layout, whether constants are shared, pulls, and the wind's tables. The step itself fills in the constants of bodies. ranges: of the
// scene's trees, as make_plan has them.
template <class T> void lay_out_lanes(const Plan<T>&, const std::vector<TreeRange>& ranges, PlannedLanes<T>&);

// Returns the lanes of a plan; null where it is on the plain path.
template <class T> const PlannedLanes<T>* planned_lanes(const Plan<T>&);
template <class T> PlannedLanes<T>* planned_lanes(Plan<T>&);

} // namespace bough::fast
