// drag.h: the air's drag on the tree's own motion, taken implicitly at one step a frame (design §4, "Drag").
//
// Why. Every joint of a path answers the drag of the bodies outboard of it. In joint rates w the drag's moment is -D w,
// D_jk = sum over bodies b outboard of both of [r_bj]*^T C_b [r_bk]*, a full matrix along each path. Explicit steps of
// I w' = -D w overflow at 1/30 s in a breeze; taking only D_jj implicitly (block Jacobi) still does from three joints in
// line on, as the lagged rest is as large. What holds is a diagonal that bounds the whole row:
//
//   S_j w_new = S_j w + h (tau_j - d_j (w_new - w)),  i.e.  w_new = w + (S_j + h d_j 1)^-1 h tau_j
// (w here the joint's rate in the axes of its body; spring.h carries L^T w, which changes by L^T times the change)
//
// with tau_j the true, present moment of the drag (external_forces.h, composite.h), S_j the joint's inertia (spring.h) and
//
//   d_j = (1/u_j) sum_b s_bj c_b W_b,   W_b = sum over the path's joints k of u_k s_bk
//
// c_b bounds body b's drag (drag_bound), s_bk >= |r_bk| is the way along the tree from joint k to b's centre of mass, and
// u_k > 0 are weights. As |D_jk| <= sum_b s_bj c_b s_bk, d_j >= sum_k |D_jk| u_k / u_j, and by Gershgorin's theorem with
// weights diag(d) - D is positive semidefinite: x^T (diag(d) - D) x >= sum_jk |D_jk| (sqrt(u_k/u_j) |x_j| -
// sqrt(u_j/u_k) |x_k|)^2 / 2. So N = S + h d bounds h D, and every eigenvalue of N^-1 h D is in [0, 1): a step of still
// air takes energy (in N's norm) and never turns a rate over, however thin the twigs, long the path or strong the wind.
// The weights are those of the branches' first modes (branch_mode.h), each scaled to a unit deflection of its tip: along
// one branch's first mode d_j u_j is then D u itself, and that mode's decay is right, not merely bounded. Other motions
// are damped less than they should be, never more. Rest is unbiased: the term vanishes with the velocities.
// W_b is constant; the outer sum goes with the composite sweep, two scalars a body.
// The split (drag, then spring) leaves the springs' propagators independent of the wind.
// Reads   c_drag_tau_w, c_drag_row, c_J_w, R_wb. Writes scaled_rate.
// After   composite. O(n), joints in parallel. Errors none.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

template <class T> void joint_drag(const Plan<T>&, State<T>&);

} // namespace bough
