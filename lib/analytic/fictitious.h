// fictitious.h: the lagged fictitious terms (20): what the joints' own motion adds to each joint's torque, one step late, for the
// analytic solver, which has none of them otherwise. A multiplier each (Fictitious, scene.h), 0 by default.
//
// Derivation, with (13)-(19) of the paper. The composite of joint c, first moment h and inertia J about the joint, takes of the moments
// about it (17)  h x a_j + J alpha_c + omega_c x J omega_c,  alpha_c = alpha_p + R w' + omega_p x omega_c (19), where w' is the change of the
// joint's own rate J(theta) theta_dot in body axes (spin_dot): with these rates (19) is exact, the paper's theta'' is theirs. J R w' is
// the spring's own term (spring.h); the rest goes over to the right, the share that carrying the composite rigidly with a moving
// ground g takes left out, which root_term.h has, exactly and in time:
//   - A h x (a_j - a_g(x_j))  - T J (alpha_p - alpha_g + omega_p x omega_c)  - G (omega_c x J omega_c - omega_g x J omega_g)
// A, T, G the multipliers acceleration, turning, gyroscopic. Of a root's joint a_j = a_g, omega_p = omega_g, alpha_p = alpha_g.
// Accelerations are those at the end of the last step, by a sweep from the roots:
//   alpha_c = (19),  a_j of c = a_j of p + alpha_p x r + omega_p x (omega_p x r)  (12),  r from p's joint to c's
// so they lag by up to a step and the terms are of first order. At the start, and of what broke off, they are 0.
//
// What is kept and what is not. (20) has what the joints below do to the composite. What the joints further out do back to it, J's
// off-diagonal blocks the other way, it takes as rigid: a soft joint on a stiff one is carried rightly, the stiff one does not feel it
// swing. So at small steps and 1 the motion is not that of the articulated bodies but nearer to it; the coupled solver has all of it. The spring's
// inertia is the composite's only with JointInertia::paper: with the default factors (branch_mode.h) the terms are out of proportion to it.
//
// Stability. The joints' accelerations that go round with a step's lag are no small ones: stiff joints answer any change with the acceleration of a free
// body, and every joint further out multiplies it. A root moved +-0.2 m at 0.5 Hz, 10 s at 1/30 s, trees of data/scenes/trees (bodies), all
// three multipliers alike; RMS of the joints' rates in the second quarter over those without the terms:
//                   0.02  0.05  0.1   0.2   0.5   1
//   maple    (285)  0.98  0.96  0.95  1.1   4.5   non-finite
//   apple    (598)  1.05  1.16  1.4   2.4   21    non-finite
//   willow   (525)  1.05  1.2   1.7   3.7   56    non-finite
// Of the terms alone at 1: acceleration 13 to 110 times, turning 14 to 120, gyroscopic 1.0. In gusty wind on a root at rest at 1 5.2, 1.01, 1.04 times.
// Smaller steps do not mend it: at 1 all three end non-finite or a hundredfold at every step from 1/30 to 1/960 s, and with JointInertia::paper from
// 0.5 on at each of these. Up to 0.1 the motion stays of the size it has without; the promises of `treeprofile stability` are for 0.
// Reads   theta_dot's omega_w, spin_dot, ground, R_wb, x_w, c_h_w, c_J_w. Writes alpha_w, a_w (accelerations), fictitious_w.
// Cost    a sweep and two 3x3 products a joint, O(n); four arrays. Errors none; non-finite in, non-finite out.
#pragma once
#include "analytic_state.h"

namespace bough {

// Whether any of the terms is asked for.
inline bool lags(const Fictitious& terms) {
    return terms.acceleration != 0 || terms.turning != 0 || terms.gyroscopic != 0;
}

// (9), (12) of all bodies: part of state_update, after poses and velocities.
template <class T> void accelerations(const Plan<T>&, State<T>&, AnalyticWork<T>&);

// fictitious_w for the step to come. After composite; needs accelerations of the poses there are.
template <class T> void fictitious_torques(const Plan<T>&, State<T>&, AnalyticWork<T>&);

} // namespace bough
