// step.h: one step of the analytic method (§4): the order of the stages, on one screen.
#pragma once
#include "plan.h"
#include "state.h"
#include <array>

namespace bough {

// Seconds per stage, filled by step() when one is given; without it no clock is read.
struct StageClock {
    std::array<double, stage_count> seconds{};
};

// Advances the state by plan.dt. Needs a state of this plan with kinematics up to date (make_state, or the step before).
// O(n), allocates nothing. Never throws; a state that became non-finite is found by first_non_finite().
template <class T> void step(const Plan<T>&, State<T>&, StageClock* clock = nullptr);

} // namespace bough
