// spring.h: analytic spring evolution, (5)-(6), with gravity's gradient, for each joint by itself.
//
//   S theta'' + beta K theta' + (K + G) theta = tau + G theta_n,  theta(0) = theta_n,  theta'(0) = theta'_n
//
// S: joint.h. tau: moment of the external forces and of gravity on the composite about the joint, in the joint frame, at
// the start of the step ("tau" of the paper's stage is the composite's, about the parent joint); G: how gravity's moment
// answers the motion, linearised where the step starts, so that gravity does not lag by a step (lagged, it pumps what
// hangs and damps what stands). Read as the paper's frozen-coefficient equation with one coefficient more; its fixed
// point is K theta = tau(theta), exactly, whatever G is.
// Gravity's moment h x g turned by phi changes by -K_g(h) phi, K_g(h) = (g.h) 1 - h g^T; its symmetric part is used (the
// other half turns with the frame). Joint j's moment answers every joint of its path: turning k further in moves all of
// h_j, turning k further out moves h_k. Along the first mode of the branch (rates in proportion to u_k, branch_mode.h)
// these add up to
//   G_j = sym K_g( (sum_{k <= j} u_k / u_j) h_j + (1/u_j) sum_{k > j} u_k h_k ),
// the row sum for gravity that F is for inertia; with JointInertia::paper K_g(h_j), the joint's own motion alone.
// (T = 1: the analytic step takes theta' for the joint's angular velocity and K theta for the spring's torque in the
// joint frame, part of its model error.)
// Solution: Cholesky S = L L^T, L^-1 (K + G) L^-T X = X Lambda by Jacobi rotations, U = L^-T X, so that U^T S U = 1; in
// the coordinates q = U^-1 theta row i is q'' + b q' + lambda q = f (oscillator.h) with b = beta (U^T K U)_ii. Where G is
// not 0, U^T K U has small terms off its diagonal: they are dropped, which leaves the damping positive.
// lambda < 0 is buckling: it grows as it does, and is counted.
// Reads   theta, theta_dot, c_h_w, c_J_w, c_out_h_w, c_tau_w, R_wb. Writes theta, theta_dot; torque_j.
// After   composite, drag. O(n), joints in parallel. Errors none; non-finite in, non-finite out.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

template <class T> void spring_update(const Plan<T>&, State<T>&);

// The spring's and damper's torque on the body [N m, joint frame], -K (theta + beta theta_dot), for all bodies.
template <class T> void spring_torque(const Plan<T>&, State<T>&);

// Eigenvectors (columns) and values of a symmetric 3x3 matrix by cyclic Jacobi rotations: small eigenvalues keep their
// relative accuracy, equal ones need no case.
template <class T> void symmetric_eigen(Matrix3<T> A, Matrix3<T>& vectors, Vector3<T>& values);

} // namespace bough
