// fictitious.h: the lagged fictitious terms (20): what the joints' own motion adds to each joint's torque, one step late. They are for the analytic
// solver, which has none of them otherwise. Each has a multiplier (Fictitious, scene.h), 0 by default.
//
// Derivation, with (13)-(19) of the paper. The composite of joint c, with first moment h and inertia J about the joint, takes from the moments about
// it (17)  h x a_j + J alpha_c + omega_c x J omega_c,  alpha_c = alpha_p + R w' + omega_p x omega_c (19). Here w' is the change of the joint's own
// rate J(theta) theta_dot in body axes (spin_dot). With these rates (19) is exact; the paper's theta'' is theirs. J R w' is the spring's own term
// (spring.h). The rest goes over to the right, without the share of carrying the composite rigidly with a moving ground g, which root_term.h has
// exactly and in time:
//   - A h x (a_j - a_g(x_j))  - T J (alpha_p - alpha_g + omega_p x omega_c)  - G (omega_c x J omega_c - omega_g x J omega_g)
// A, T, G are the multipliers acceleration, turning, gyroscopic. For a root's joint a_j = a_g, omega_p = omega_g, alpha_p = alpha_g. Accelerations
// are those at the end of the last step, by a sweep from the roots:
//   alpha_c = (19),  a_j of c = a_j of p + alpha_p x r + omega_p x (omega_p x r)  (12),  r from p's joint to c's
// So they lag by up to a step and the terms are of first order. They are 0 at the start, and for what broke off.
//
// What is kept and what is not. (20) has what the joints below do to the composite. It takes as rigid what the joints further out do back to it, J's
// off-diagonal blocks the other way. So a soft joint on a stiff one is carried rightly, but the stiff one does not feel it swing. At small steps and
// multipliers of 1 the motion is thus not that of the articulated bodies but nearer to it; the coupled solver has all of it. The spring's inertia is
// the composite's only with JointInertia::paper. With the default factors (branch_mode.h) the terms are out of proportion to it.
//
// Stability. The joints' accelerations that return with a step's lag are not small. Stiff joints answer any change with the acceleration of a free
// body, and every joint further out multiplies it. Measured: a root moved +-0.2 m at 0.5 Hz, 10 s at 1/30 s, trees of data/scenes/trees (bodies), all
// three multipliers alike; RMS of the joints' rates in the second quarter over those without the terms:
//                   0.02  0.05  0.1   0.2   0.5   1
//   maple    (285)  0.98  0.96  0.95  1.1   4.5   non-finite
//   apple    (598)  1.05  1.16  1.4   2.4   21    non-finite
//   willow   (525)  1.05  1.2   1.7   3.7   56    non-finite
// Each term alone at 1 gives: acceleration 13 to 110 times, turning 14 to 120, gyroscopic 1.0; in gusty wind on a root at rest 5.2, 1.01, 1.04 times.
// Smaller steps do not mend it: at 1 all three end non-finite or a hundredfold at every step from 1/30 to 1/960 s, and with JointInertia::paper from
// 0.5 on at each of these. Up to 0.1 the motion stays of the size it has without the terms. The promises of `treeprofile stability` are for 0.
// Reads   theta_dot's omega_w, spin_dot, ground, R_wb, x_w, c_h_w, c_J_w. Writes alpha_w, a_w (accelerations), fictitious_w.
// Cost    a sweep and two 3x3 products a joint, O(n); four arrays. Errors none; non-finite in, non-finite out.
#pragma once
#include "analytic_state.h"

namespace bough {

// True if any of the terms is asked for.
inline bool lags(const Fictitious& terms) {
    return terms.acceleration != 0 || terms.turning != 0 || terms.gyroscopic != 0;
}

// Finds (9), (12) of all bodies. It is part of state_update, after poses and velocities.
template <class T> void accelerations(const Plan<T>&, State<T>&, AnalyticWork<T>&);

// Finds fictitious_w for the step to come. Runs after composite, and needs accelerations of the present poses.
template <class T> void fictitious_torques(const Plan<T>&, State<T>&, AnalyticWork<T>&);

} // namespace bough
