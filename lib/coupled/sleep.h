// sleep.h: blocks of lanes whose motion has settled are left out of the step until something moves them again.
//
// A block (layout.h: a subtree, or whole trees) falls asleep when for a second, and ten steps, each of its bodies has turned by less than
// the plan's rate [rad/s], and so have the bodies above that it stands on, under forces that stay as they are. Its rates and
// their changes are set to zero, it is swept once more, and what it hands inward (articulated inertia and force, at that
// pose) stands from then on for the block: what carries it feels it as before. Asleep it costs nothing: no sweep, no memory.
//   wakes     when what acts on it is changed from outside (wake_all), when a pull on one of its bodies changes, or an attachment of one, when what it stands on turns faster than the rate, or has turned by
//             more than ten seconds of the rate since blocks sleep on it. The top sleeps when all that stands on it does, and
//             wakes with the first of it
//   drift     a mode of angular frequency w that is put to rest had an amplitude of at most r / w, or where a second is short
//             beside it, 2 r / w^2 (its bodies turned by less than r for a second): 1e-6 rad at 0.7 Hz with treesim's 1e-5
//   left out  with the analytic step, and where forces never stay as they are: a wind with gusts or turbulence, moved roots,
//             forces that the caller may put on bodies
// What stands in balance, though it would buckle once touched, sleeps as it stands.
// Decided by block from numbers that do not depend on threads, so the hash does not. What a sleeper hands inward cannot be
// made again from theta alone: saved_sleep is what a saved state carries of it.
// Reads   SweepFlags::omega2, pulls. Writes Lanes::rest, flags.asleep, rates at the step's end of what falls asleep.
// Cost    O(blocks + pulls) a step; O(rows) of a block when it falls asleep. Errors: restore_sleep.
#pragma once
#include "coupled_lanes_state.h"

namespace bough::fast {

// Whether the plan's scene lets anything sleep, at a rate of `rate` [rad/s]; 0: not asked for. After plan_lanes.
template <class T> void plan_sleep(const Plan<T>&, CoupledLanesPlan<T>&, double rate);

// Steps of dt [s] that a block has to be slow for.
std::uint32_t steps_to_settle(double dt);

// At a step's start: who wakes, by its pulls or by who else is awake. Counts the bodies that sleep through the step.
template <class T>
void wake_blocks(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&, double time);
// All of them, between two steps: after gravity, wind or wood was changed. Allocates nothing.
template <class T> void wake_all(const CoupledLanesPlan<T>&, CoupledLanesState<T>&);
// At its end: who has settled. met: of each block.
template <class T>
void rest_blocks(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const std::vector<SweepFlags>& met);
// Its motion at the step's end is that at its start.
template <class T> void keep_motion(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const Block&);

template <class T> bool all_asleep(const Lanes<T>& lanes) {
    for (const BlockRest& block : lanes.rest)
        if (block.rest != Rest::asleep) return false;
    return !lanes.rest.empty();
}

// What a saved state carries: the turn of what is slept on, two numbers a block, and what each sleeping block's ports hand
// inward. Empty where nothing has settled at all.
template <class T> std::vector<double> saved_sleep(const CoupledLanesPlan<T>&, const CoupledLanesState<T>&);
// After restart(). Throws std::invalid_argument where the numbers are not of this plan.
template <class T> void restore_sleep(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const std::vector<double>&);

} // namespace bough::fast
