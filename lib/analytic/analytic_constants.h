// analytic_constants.h: what the analytic solver knows of a tree beforehand so that steps of any size stay bounded: factors of inertia
// (branch_mode.h), bounds of gravity's rows (spring.h) and, with a wind, drag's (drag.h).
#pragma once
#include "../model/tree.h"
#include "analytic_state.h"

namespace bough {

// Fills in `own` from a checked, scaled tree with no rigid bodies, whose scene and composite masses the plan has. O(n).
template <class T> void take_analytic_constants(const Plan<T>&, const Tree&, AnalyticPlan<T>& own);

} // namespace bough
