// state_update.h: rigid body state update, (7), (8), (10), (11), one forward sweep.
//
// R_wc = R_wp R_pj exp(theta) (7). The joint of c stays on its parent, x_c = x_p + R_wp d (10), with x the joint's place. Bodies have their origin at
// their own joint here, so (10)'s d_j^c is minus the centre of mass. Velocities are found only where the plan has a reader for them (wind, --fields
// velocity): omega_c = omega_p + R_wc J theta_dot, which is (8) with the exact angular velocity of the joint for theta_dot (math.h), and v_c =
// v_joint + omega_c x R_wc com (11). Accelerations (9), (12) have one reader, which finds them itself (fictitious.h). Roots hang on the ground, which
// rests or moves (state.ground, root_motion.h); their joints' places, frames and velocities go with it.
// Reads   theta, theta_dot, ground. Writes R_wb, x_w; omega_w, v_w. Runs after spring. Needs parent[i] < i. O(n). Errors none.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

template <class T> void state_update(const Plan<T>&, State<T>&);

// Brings up to date all that depends on theta and theta_dot in document order, at the state's number of steps: the ground, poses, velocities,
// springs' torques, as far as the plan has them.
template <class T> void update_kinematics(const Plan<T>&, State<T>&);

} // namespace bough
