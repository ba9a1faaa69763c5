// plan_lanes.h: fills in Plan::lanes: the layout, and the bodies' constants in rows. O(n log n).
#pragma once
#include "../stages/plan.h"

namespace bough::fast {

// Whether the fast path holds all that the plan asks for: the coupled step by complex poles, or the analytic step on grounds at rest; no joint limits. Sets
// lanes.on and lanes.reason; where on, the rest of lanes. Reads the plan's constants. ranges: of the scene's trees, as make_plan has them.
template <class T> void plan_lanes(Plan<T>&, const std::vector<TreeRange>& ranges);

} // namespace bough::fast
