#include "explain_lanes.h"
#include "../base/shortest_text.h"
#include "target.h"

namespace bough::fast {

template <class T>
void explain_lanes(const Plan<T>& plan, const PlannedLanes<T>& lanes, std::initializer_list<Stage> stages,
                   PlanAccount& account) {
    for (const Stage stage : stages) account.stage(stage, false, in_lanes);
    account.stage(Stage::wind_field, false, plan.wind ? in_lanes + wind_parts(plan) : "no wind");
    const std::string forces = plan.forces ? "; " + forces_reason(plan) : "";
    const std::string sleep = lanes.sleep.on ? "; asleep below " + four_digits(lanes.sleep.rate) + " rad/s"
                                             : "; no sleep: " + lanes.sleep.reason;
    account.stage(Stage::lanes, true,
                  std::string("SIMD ") + target_name(lanes.target) + forces + moved_roots(plan) + sleep);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void explain_lanes(const Plan<T>&, const PlannedLanes<T>&, std::initializer_list<Stage>, PlanAccount&);
#include "../base/instantiate.inc"

} // namespace bough::fast
