// step.h: one step of the analytic method (§4): the order of the stages, on one screen. (The same in SIMD lanes:
// fast/analytic_lanes_step.h.)
//
// What was tried and taken out: keeping a joint's modes and propagators until its composite has turned by about 0.05 rad. It pays only in still air
// (half a step, where `coupled` sleeps for nothing): 10 000 bare bodies in gusts took 34 ns in place of 44, a million a quarter more than without, as
// gusts make fine twigs anew every few frames, trees in leaf as much; it added 1.6 % (bare) to 2.4 % (in leaf) of the deflection to the error.
#pragma once
#include "plan.h"
#include "state.h"
#include <array>
#include <chrono>

namespace bough {

// Seconds per stage, filled by step() when one is given; without it no clock is read.
struct StageClock {
    std::array<double, stage_count> seconds{};
};

// Runs one stage: counted, and timed where there is a clock.
template <class T, class Body> void run_stage(Stage stage, State<T>& state, StageClock* clock, Body&& body) {
    using Time = std::chrono::steady_clock;
    const Time::time_point start = clock ? Time::now() : Time::time_point{};
    body();
    ++state.calls[std::size_t(stage)];
    if (clock) clock->seconds[std::size_t(stage)] += std::chrono::duration<double>(Time::now() - start).count();
}

// Advances the state by plan.dt. Needs a state of this plan with kinematics up to date (make_state, or the step before).
// O(n), allocates nothing. A state that became non-finite is found by first_non_finite().
// Throws std::logic_error, with the state as it was, for a plan that it is not for: of another solver, or with lanes, where a state has
// other arrays. advance() (reference/advance.h) takes those.
template <class T> void step(const Plan<T>&, State<T>&, StageClock* clock = nullptr);

} // namespace bough
