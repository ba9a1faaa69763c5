// articulated.h: the full dynamics of the articulated tree, one articulated-body pass in O(n) (Featherstone 2008, chapter 7).
//
// Equations. Joint i holds the rotation vector theta and the rate w = J theta_dot of its body against its parent, in the axes
// of the body. In any axes, about each joint, with c the body's centre of mass, J_o its inertia about the joint:
//   omega = omega_p + R w      alpha = alpha_p + R w' + omega_p x R w
//   v     = v_p + omega_p x r  a     = a_p + alpha_p x r + omega_p x (omega_p x r)
//   F = m (a - g + alpha x c + omega x (omega x c)) - f      N = J_o alpha + omega x J_o omega + m c x (a - g) - n
// f, n external force and moment: pulls and the air (air.h). What the joint carries, summed over the outboard bodies, turns
// about it by the spring's torque alone,
//   tau = -R T^T K (theta + beta theta_dot),  theta_dot = T w,  T = J^-1:
// the law of the energy theta^T K theta / 2 with dissipation beta theta_dot^T K theta_dot / 2 (design: it conserves for any K).
//
// h > 0 makes it linearly implicit: torque and air are those at the end of a step of h,
//   theta_dot_1 = T (w + h w'), theta_1 = theta + h theta_dot_1, u_1 = u - h a_c,
// with T, R, the air's damping D, what it resists turning by and a bound on how it turns plates (air.h) at the start. The joint then answers like an
// inertia Z = h (h + beta) R T^T K T R^T, and each body has h D at its centre of mass more of mass. No step is then unstable for its springs, dampers
// or air's drag.
//
// Terms quadratic in omega stay explicit. What turns by more than a radian in h is not resolved by it, and would be thrown out: there,
// and in those terms alone, omega is taken as 1 / h (h > 0 only). Counted in pass.fast.
//
// Sweeps. Outward: kinematics, the biases (what of a body's accelerations neither the parent's nor the joint's bring) and
// each body's own inertia. Inward, with the biases' own wrench in N and F, E = (A + Z)^-1, u = tau - N:
//   A' = Z E A,  B' = Z E B,  M' = M - B^T E B,  N' = N + A E u,  F' = F + B^T E u, turned and shifted by r to the parent.
// Z E A is A - A E A without the subtraction: without a spring it is 0 (and N' tau), not what rounding left, and with a
// stiff one it keeps its digits. Outward: w' = E (u - A alpha_p - B a_p), alpha_p, a_p those of the joint's place on the parent.
//
// Digits. Every body is computed in its own axes: there a thin rod's small inertia about itself stands apart from the rest,
// where in world axes the rounding of what hangs on it would cover it (three hundred bodies with twigs of 0.1 mm lost ten
// digits to that). What is left to lose is what rounding the result costs: in a chain 1e5 deep that is a moment of 1e-2
// of those that act, because the joints' accelerations nearly cancel in the bodies'. tests/lib/study/articulated.cpp.
// A body without extent about an axis (below 1e-7 of its length) would make A singular: four roundings of its trace are added.
// Reads   plan constants, theta and rate in pass.body. Writes all of pass. O(n), about 0.4 us a body. Errors none; non-finite
//         in, non-finite out.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"
#include "articulated_pass.h"

namespace bough {

// The pass at pass.body[i].theta, rate at `time` [s]; h = 0: the plain accelerations, else the mean ones of a step of h from
// there: wind and pulls are those at its end, the moving ground's acceleration (root_motion.h) is its mean.
void articulated_pass(const Plan<double>&, ArticulatedPass& pass, double time, double h);

} // namespace bough
