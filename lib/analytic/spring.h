// spring.h: analytic spring evolution, (5)-(6), with gravity's gradient, for each joint by itself.
//
// Equation. In theta, with J = J(theta) the body's rates of it (omega_b = J theta_dot, math.h) and T = J^-1, everything of
// the joint is written in the axes of its own body and frozen at the start of the step but the relative rotation phi,
// d theta = T phi:
//   S phi'' + beta K_b phi' + (K_b + G) phi = tau - T^T K theta,     K_b = T^T K T
// S: the composite's inertia about the joint (joint.h). tau: moment of the external forces and of gravity on the composite
// about the joint (the stage's "tau" is the composite's), taken at the start of the step. T^T K theta is the torque of the
// springs, from the energy theta^T K theta / 2; the paper takes T = 1, which is right for small angles only: measured, T = 1
// gains energy from |theta| = 1 rad on (a single rod swinging through 2.6 rad grew fivefold in 10 s), the exact map does not.
// The fixed point is T^T K theta = tau(theta), exactly, whatever S and G are.
//
// G, gravity's gradient. Gravity's moment h x g, turned by phi, changes by -K_g(h) phi, K_g(h) = (g.h) 1 - h g^T. Held
// constant over the step instead (G = 0), it lags by half a step and pumps what hangs. G = sym K_g(h_j) + gamma_j 1: the
// joint's own motion, exact, and a bound on what the path's other joints contribute. The Hessian of gravity's potential is
// block diagonal in the bodies' absolute rotations psi_b = sum of phi over the path, with blocks sym K_g(P_b), |.| <= |g||P_b|,
// P_b the first moment that body b's own turning moves (its mass and, at its children's joints, their composites'). As
// 2 |phi_j.phi_k| <= (u_k/u_j) |phi_j|^2 + (u_j/u_k) |phi_k|^2 for any weights u > 0,
//   gamma_j = sum_{b outboard or j} |g| |P_b| (U_b - u_j) / u_j,     U_b = sum of u over b's path
// makes the sum over joints of phi^T G phi at least the Hessian's form: a step of the joints, each by itself, then takes
// at least as much energy as it gives gravity (to second order of the step's rotation). gamma is constant, zero for a single
// joint, and small beside K in wood; where it is not, it damps (as what stands is damped by lag in any case).
//
// A moving ground. Where the tree's root is moved, g is the apparent gravity at the joint, and the ground's turning adds
// to tau and G: root_term.h. What the joints' own motion adds to tau by (20), one step late, where the scene asks for it: fictitious.h.
//
// Air. With wind, the bounds d' and gamma of drag.h join the damping and G; drag.h says why.
//
// Carrying. S changes with the pose of what is outboard, and a rate carried through a changing inertia gains or loses
// energy that nobody did work for: theta_dot kept as it is pumps soft trees without bound. What is carried from step to step
// is instead w = L^T omega_b, S = L L^T: |w|^2 / 2 is the joint's kinetic energy, so that the change of S does no work.
//
// Together: with constant K and beta, in still air or none, kinetic (|w|^2 / 2) + elastic + potential energy does not grow,
// for any K >= 0, beta >= 0 and step, up to the third order of a step's rotations under gravity (tests/lib/analytic/energy.cpp).
//
// Solution. A = L^-1 (K_b + G) L^-T = X Lambda X^T by Jacobi rotations, U = L^-T X, so that U^T S U = 1 and row i is
// q'' + b q' + lambda q = r with b = beta (U^T K_b U)_ii, v = X^T w (oscillator.h). Where G is not 0, U^T K_b U has small
// terms off its diagonal: they are dropped, which leaves the damping positive. lambda < 0 is buckling: it grows as it does,
// and is counted. lambda is bounded where its square would overflow (oscillator.h), counted.
// Large turns. All of the above is frozen at the step's start, and right to second order of phi. A joint that turns by more than
// 0.3 rad in a step has left that; there, and there alone, its energy is checked with the composite taken rigid: kinetic
// + elastic - g.(turned h) less the work of what is held constant, tau.phi. What it has gained beyond, the rate gives back
// (down to rest). Counted; idle while the angles a step are small, which is what the method is for.
// Limits. Where the scene has joint limits, the step ends with them: joint_limit.h. Counted.
// Half turns. theta is the rotation vector "in the standard fashion" (§3), |theta| <= pi: a joint that turns past half a turn is as
// far from rest the other way round, at the same elastic energy, and its spring pulls it on. Counted; the small angles
// that the method assumes were left long before.
// Reads   theta, scaled_rate, c_h_w, c_J_w, c_tau_w, R_wb, root_load, fictitious_w. Writes theta, theta_dot, scaled_rate, spin_dot.
// After   composite, drag, root_loads, fictitious_torques. O(n), joints in parallel. Errors none; non-finite in, non-finite out.
#pragma once
#include "analytic_state.h"

namespace bough {

template <class T> void spring_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&);
// Of one joint, what happened returned instead of counted.
template <class T>
StepFlags spring_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, std::size_t body);

// Eigenvectors (columns) and values of a symmetric 3x3 matrix by cyclic Jacobi rotations: small eigenvalues keep their
// relative accuracy, equal ones need no case.
template <class T> void symmetric_eigen(Matrix3<T> A, Matrix3<T>& vectors, Vector3<T>& values);

} // namespace bough
