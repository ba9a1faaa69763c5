// change.h: what of a plan changes between two steps, whatever the solver, where it can (Stepper).
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// All joints' stiffness and damping times these. O(n).
template <class T> void scale_wood(Plan<T>&, double stiffness, double damping);

// Steps of another length [s] from here on; the time stays. What the last step changed, from which the next one extrapolates, is taken in
// proportion: the motion's second order stays. O(n), allocates nothing.
template <class T> void change_step(Plan<T>&, State<T>&, double dt);

} // namespace bough
