// explain_lanes.h: what any step in lanes says of itself in a plan's account.
#pragma once
#include "../plan/explain.h"
#include "plan_lanes.h"
#include <initializer_list>

namespace bough::fast {

constexpr const char* in_lanes = "in lanes"; // a stage's reason, and an array's

// stages: of the plain step, which the lanes have in them.
template <class T>
void explain_lanes(const Plan<T>&, const PlannedLanes<T>&, std::initializer_list<Stage> stages, PlanAccount&);

} // namespace bough::fast
