// sleep.h: blocks of lanes whose motion has settled are left out of the step until something moves them again.
//
// A block (layout.h: a subtree, or whole trees) falls asleep when, for a second and ten steps, each of its bodies has turned by less than the plan's
// rate [rad/s], and so have the bodies above that it stands on, under forces that stay as they are. Its rates and their changes are set to zero, and
// it is swept once more. What it then hands inward (articulated inertia and force, at that pose) stands for the block from then on: what carries it
// feels it as before. A sleeping block costs nothing: no sweep, no memory.
//   wakes     when what acts on it is changed from outside (wake_all), when a pull on one of its bodies, or an attachment of one, changes, and when
//             what it stands on turns faster than the rate, or has turned by more than ten seconds of the rate since blocks sleep on it. The top
//             sleeps when all that stands on it does, and wakes with the first of it
//   drift     a mode of angular frequency w that is put to rest had an amplitude of at most r / w, or where a second is short
//             beside it, 2 r / w^2 (its bodies turned by less than r for a second): 1e-6 rad at 0.7 Hz with treesim's 1e-5
//   left out  with the analytic step, and where forces never stay as they are: a wind with gusts or turbulence, moved roots,
//             forces that the caller may put on bodies
// What stands in balance, though it would buckle once touched, sleeps as it stands. Sleep is decided by block from numbers that do not depend on
// threads, so the hash does not depend on them either. What a sleeper hands inward cannot be made again from theta alone: a saved state carries it as
// saved_sleep.
// Reads   SweepFlags::omega2, pulls. Writes Lanes::rest, flags.asleep, rates at the step's end of what falls asleep.
// Cost    O(blocks + pulls) a step; O(rows) of a block when it falls asleep. Errors: restore_sleep.
#pragma once
#include "coupled_lanes_state.h"

namespace bough::fast {

// Decides whether the plan's scene lets anything sleep, at a rate of `rate` [rad/s]; 0: not asked for. Called after lay_out_lanes.
template <class T> void plan_sleep(const Plan<T>&, CoupledLanesPlan<T>&, double rate);

// Returns for how many steps of dt [s] a block has to be slow.
std::uint32_t steps_to_settle(double dt);

// Called at a step's start. Wakes blocks by their pulls, or because another block is awake. Counts the bodies that sleep through the step.
template <class T>
void wake_blocks(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&, double time);
// Wakes all blocks, between two steps: after gravity, wind or wood was changed. Allocates nothing.
template <class T> void wake_all(const CoupledLanesPlan<T>&, CoupledLanesState<T>&);
// Called at a step's end. Finds the blocks that have settled. met: of each block.
template <class T>
void rest_blocks(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const std::vector<SweepFlags>& met);
// Makes the block's motion at the step's end that at its start.
template <class T> void keep_motion(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const Block&);

template <class T> bool all_asleep(const Lanes<T>& lanes) {
    for (const BlockRest& block : lanes.rest)
        if (block.rest != Rest::asleep) return false;
    return !lanes.rest.empty();
}

// Returns what a saved state carries: the turn of what is slept on, two numbers a block, and what each sleeping block's ports hand inward. It is
// empty where nothing has settled at all.
template <class T> std::vector<double> saved_sleep(const CoupledLanesPlan<T>&, const CoupledLanesState<T>&);
// Called after restart(). Throws std::invalid_argument where the numbers are not of this plan.
template <class T> void restore_sleep(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const std::vector<double>&);

} // namespace bough::fast
