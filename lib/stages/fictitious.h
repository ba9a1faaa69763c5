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
// Stability.
// STABILITY-TO-MEASURE
// Reads   theta_dot's omega_w, spin_dot, ground, R_wb, x_w, c_h_w, c_J_w. Writes alpha_w, a_w (accelerations), fictitious_w.
// Cost    a sweep and two 3x3 products a joint, O(n); four arrays. Errors none; non-finite in, non-finite out.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// Whether any of the terms is asked for.
inline bool lags(const Fictitious& terms) {
    return terms.acceleration != 0 || terms.turning != 0 || terms.gyroscopic != 0;
}

// A scene for any solver: those that have these terms by nature get it without, where make_plan would refuse it.
inline Scene for_solver(Scene scene, Solver solver) {
    if (solver != Solver::analytic) scene.fictitious.reset();
    return scene;
}

// (9), (12) of all bodies: part of state_update, after poses and velocities.
template <class T> void accelerations(const Plan<T>&, State<T>&);

// fictitious_w for the step to come. After composite; needs accelerations of the poses there are.
template <class T> void fictitious_torques(const Plan<T>&, State<T>&);

} // namespace bough
