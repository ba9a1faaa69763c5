// spring_torque.h: what the joints' springs and dampers do to their bodies, for those who want to read it.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// The spring's and damper's torque on the body [N m, joint frame], -T_j^T K (theta + beta theta_dot) with T_j = T of the
// joint frame's rates, into torque_j for all bodies.
template <class T> void spring_torque(const Plan<T>&, State<T>&);

} // namespace bough
