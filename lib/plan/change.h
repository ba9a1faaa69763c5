// change.h: what of a plan changes between two steps with any solver that can change it (Stepper).
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// Both wake what sleeps.
//
// Multiplies all joints' stiffness and damping by these. O(n).
template <class T> void scale_wood(Plan<T>&, State<T>&, double stiffness, double damping);

// Makes steps of another length [s] from here on; the time stays. What the last step changed, from which the next one extrapolates, is scaled in
// proportion, so the motion stays of second order. O(n). Allocates nothing.
template <class T> void change_step(Plan<T>&, State<T>&, double dt);

} // namespace bough
