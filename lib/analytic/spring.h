// spring.h: analytic spring evolution, (5)-(6), with gravity's gradient, for each joint by itself.
//
// Equation. J = J(theta) is the body's rates of theta (omega_b = J theta_dot, math.h), and T = J^-1. Everything of the joint is written in the axes
// of its own body and frozen at the start of the step, except the relative rotation phi, d theta = T phi:
//   S phi'' + beta K_b phi' + (K_b + G) phi = tau - T^T K theta,     K_b = T^T K T
// S is the composite's inertia about the joint (joint.h). tau is the moment of the external forces and of gravity on the composite about the joint
// (the stage's "tau" is the composite's), taken at the start of the step. T^T K theta is the torque of the springs, from the energy theta^T K theta /
// 2. The paper takes T = 1, which is right for small angles only. Measured, T = 1 gains energy from |theta| = 1 rad on (a single rod swinging through
// 2.6 rad grew fivefold in 10 s); the exact map does not. The fixed point is T^T K theta = tau(theta), exactly, whatever S and G are.
//
// G is gravity's gradient. Gravity's moment h x g, turned by phi, changes by -K_g(h) phi, K_g(h) = (g.h) 1 - h g^T. If it were held constant over the
// step (G = 0), it would lag by half a step and pump what hangs. G = sym K_g(h_j) + gamma_j 1 has the joint's own motion, exactly, and a bound on
// what the path's other joints contribute. The Hessian of gravity's potential is block diagonal in the bodies' absolute rotations psi_b = sum of phi
// over the path, with blocks sym K_g(P_b), |.| <= |g||P_b|. P_b is the first moment that body b's own turning moves (of its mass and, at its
// children's joints, their composites). As 2 |phi_j.phi_k| <= (u_k/u_j) |phi_j|^2 + (u_j/u_k) |phi_k|^2 for any weights u > 0,
//   gamma_j = sum_{b outboard or j} |g| |P_b| (U_b - u_j) / u_j,     U_b = sum of u over b's path
// makes the sum over joints of phi^T G phi at least the Hessian's form. A step of the joints, each by itself, then takes at least as much energy as
// it gives gravity (to second order of the step's rotation). gamma is constant, zero for a single joint, and small beside K in wood. Where it is not
// small, it damps (as what stands is damped by lag in any case).
//
// A moving ground. Where the tree's root is moved, g is the apparent gravity at the joint, and the ground's turning adds to tau and G (root_term.h).
// Where the scene asks for it, the joints' own motion adds to tau by (20), one step late (fictitious.h).
//
// Air. With wind, the bounds d' and gamma of drag.h join the damping and G; drag.h says why.
//
// Carrying. S changes with the pose of what is outboard, and a rate carried through a changing inertia gains or loses energy without work: theta_dot
// kept as it is pumps soft trees without bound. So w = L^T omega_b, S = L L^T, is carried from step to step instead. |w|^2 / 2 is the joint's kinetic
// energy, so the change of S does no work.
//
// Together: with constant K and beta, in still air or none, kinetic (|w|^2 / 2) + elastic + potential energy does not grow,
// for any K >= 0, beta >= 0 and step, up to the third order of a step's rotations under gravity (tests/lib/analytic/energy.cpp).
//
// Solution. A = L^-1 (K_b + G) L^-T = X Lambda X^T by Jacobi rotations, U = L^-T X. So U^T S U = 1, and row i is q'' + b q' + lambda q = r with b =
// beta (U^T K_b U)_ii, v = X^T w (oscillator.h). Where G is not 0, U^T K_b U has small terms off its diagonal. They are dropped, which leaves the
// damping positive. lambda < 0 is buckling: it grows as it does, and is counted. lambda is bounded where its square would overflow (oscillator.h),
// and this is counted.
// Large turns. All of the above is frozen at the step's start, and right to second order of phi. A joint that turns by more than 0.3 rad in a step
// has left that range. Only there its energy is checked with the composite taken rigid: kinetic + elastic - g.(turned h) less the work of what is
// held constant, tau.phi. The rate gives back what it has gained beyond that (down to rest). This is counted. It is idle while the angles a step are
// small, for which the method is meant.
// Limits. Where the scene has joint limits, the step ends with them (joint_limit.h). This is counted.
// Half turns. theta is the rotation vector "in the standard fashion" (§3), |theta| <= pi. A joint that turns past half a turn is as far from rest the
// other way round, at the same elastic energy, and its spring pulls it on. This is counted; the joint has then long left the small angles that the
// method assumes.
// Reads   theta, scaled_rate, c_h_w, c_J_w, c_tau_w, R_wb, root_load, fictitious_w. Writes theta, theta_dot, scaled_rate, spin_dot.
// After   composite, drag, root_loads, fictitious_torques. O(n), joints in parallel. Errors none; non-finite in, non-finite out.
#pragma once
#include "analytic_state.h"

namespace bough {

template <class T> void spring_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&);
// Steps one joint. Returns what happened instead of counting it.
template <class T>
StepFlags spring_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, std::size_t body);

} // namespace bough
