// present.h: where the fast path's rows are the state proper, its arrays in document order are brought up to date when they are read.
#pragma once
#include "../stages/state.h"

namespace bough {

// Brings theta, theta_dot, what the solver carries besides, poses, the ground and what the plan's wishes add (velocities, torques) to the state's present
// step. Nothing to do where the plan has no lanes, or they are. Without Plan::pose: theta, theta_dot and what is carried alone, whose arrays
// are made for it; restart() gives them back. O(n).
template <class T> void present(const Plan<T>&, State<T>&);

} // namespace bough
