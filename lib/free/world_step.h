// world_step.h: one step of all in a scene: trees, what breaks off them, balls, ground (§6, §8).
//
// Order of a step:
//   walkers   their weight on what they are on goes to the forces of the step (walker.h)
//   trees     the plan's solver, with the contacts' forces from the step before (advance() of plan/state.h)
//   flight    each free body's way through the air (flight.h; leaves: leaf_flight.h)
//   contacts  what they meet on it, trees on their own ways, and the impulses (contact.h). A free body goes to where it met something first, and on
//             from there with its new velocity up to the next thing, which is left to the next step. It does not end behind the point that it met.
//             What overlapped before is pushed out by a fifth a step. With the paper's pair, the tree takes the penalty force, and the free body the
//             tree's velocity along the normal where that pushes it away
//   fracture  joints whose springs' torque is above their threshold (fracture.h)
#pragma once
#include "world.h"

namespace bough {

// Takes one step of all. Without a world that is on, it is advance(plan, state).
template <class T> void advance(Plan<T>&, State<T>&, World<T>&, StageClock* clock = nullptr);

} // namespace bough
