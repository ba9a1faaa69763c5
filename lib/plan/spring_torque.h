// spring_torque.h: the torques of the joints' springs and dampers on their bodies, for those who want to read them.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// Writes torque_j of all bodies: the torque of spring and damper on the body [N m, joint frame], -T_j^T K (theta + beta theta_dot), with T_j = T of
// the joint frame's rates.
template <class T> void spring_torque(const Plan<T>&, State<T>&);

// [Pa] Fills in the stress by which the present torque_j bends each body's wood (model/bending_stress.h); 0 for all but branches. Needs
// Wishes::stress. O(bodies). Allocates nothing once the array has grown.
template <class T> void bending_stresses(const Plan<T>&, const State<T>&, std::vector<double>& stress);

} // namespace bough
