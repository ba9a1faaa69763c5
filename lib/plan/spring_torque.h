// spring_torque.h: what the joints' springs and dampers do to their bodies, for those who want to read it.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// The spring's and damper's torque on the body [N m, joint frame], -T_j^T K (theta + beta theta_dot) with T_j = T of the
// joint frame's rates, into torque_j for all bodies.
template <class T> void spring_torque(const Plan<T>&, State<T>&);

// [Pa] What the present torque_j bends each body's wood by (model/bending_stress.h), 0 for what is no branch. Needs Wishes::stress. O(bodies);
// allocates nothing once the array has grown.
template <class T> void bending_stresses(const Plan<T>&, const State<T>&, std::vector<double>& stress);

} // namespace bough
