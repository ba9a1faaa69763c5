// analytic_step.h: one step of the analytic method (§4): the order of the stages, on one screen. (analytic/analytic_lanes_step.h does the same in
// SIMD lanes.)
//
// Tried and taken out: keeping a joint's modes and propagators until its composite has turned by about 0.05 rad. It pays only in still air (half a
// step, where `coupled` sleeps for nothing). In gusts, 10 000 bare bodies took 34 ns in place of 44, but a million took a quarter more than without,
// as gusts make fine twigs anew every few frames; trees in leaf took as much. It added 1.6 % (bare) to 2.4 % (in leaf) of the deflection to the
// error.
#pragma once
#include "analytic_state.h"

namespace bough {

// Advances the state by plan.dt. Needs a state of this plan with kinematics up to date (make_state, or the step before).
// O(n), allocates nothing. A state that became non-finite is found by first_non_finite().
template <class T>
void analytic_step(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, StageClock* clock);

} // namespace bough
