// drag.h: the air's drag on the tree's own motion, taken implicitly at one step a frame (design §4, "Drag").
//
// Why. Every joint of a path answers the drag of the bodies outboard of it. In joint rates w the drag's moment is -D w, D_jk = sum over bodies b
// outboard of both of [r_bj]*^T C_b [r_bk]*, a full matrix along each path. Explicit steps of I w' = -D w overflow at 1/30 s in a breeze. Taking only
// D_jj implicitly (block Jacobi) still overflows from three joints in line on, as the lagged rest is as large. A diagonal that bounds the whole row
// holds:
//
//   S_j w_new = S_j w + h (tau_j - d_j (w_new - w)),  i.e.  w_new = w + (S_j + h d_j 1)^-1 h tau_j
// (w is here the joint's rate in the axes of its body; spring.h carries L^T w, which changes by L^T times the change)
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
// The wind itself, tau at rest, goes to the spring (spring.h). It is as stiff: a leaf or a 1 mm twig reaches the wind's speed within milliseconds,
// and a force held for a frame would throw it round by radians. There the bounds of the force at rest join the oscillator, with velocity as
//   d'_j = (1/u_j) sum_b s_bj (wind_bound)_b W_b, and with direction gamma_j = sum_b s_bj (turn_bound)_b:
// In S w' + (beta K + d') w + (K + G + gamma) phi = r + d' w_0 both enter with w - w_0 and phi alone. So at first order of the step nothing is
// changed, and the fixed point is the true one. d' is a secant: kappa rho A |u| is what the force falls by, over the speed, from a body at rest to
// one that goes with the wind. So what is light is driven to the wind's speed, no faster and no slower. gamma is how the joint's own turning changes
// its composite's moment; the other joints' part is left out.
// Also tried, on apple trees of 1 000 bodies in gusty wind (RMS error of the tips against the articulated reference, share of their RMS deflection, 1
// step a frame; bare / in leaf; the limit of small steps: 33 / 57 %):
//   the tangent 2 kappa rho A |u| and gamma a row sum over the path, as d'   57 / 81 %   creeps: in 20 s not at rest in a steady wind
//   the secant, gamma likewise                                             54 / 80 %
//   the tangent, gamma as here                                             41 / 63 %
//   the secant, gamma as here                                              34 / 56 %
//   the secant, gamma of the own body alone                                34 / 56 %   K x 1e-3: leaves spin for ever
//   no d', gamma of the own body                                           37 / 89 %   leaves spin
//   neither                                                                37 / 89 %   leaves spin
// In still air d' and gamma are zero, and drag takes energy alone.
// The weights are those of the branches' first modes (branch_mode.h), each scaled to a unit deflection of its tip, doubled at each side branch on the
// way out. What is further out is lighter, answers the drag first, and is to be bounded least. Along one branch's first mode d_j u_j is D u itself,
// apart from the other branches of the path. Motions are dragged less than they should be, never more.
// W_b is constant. The outer sums go with the composite sweep, six scalars a body. (The price is that the spring's propagators depend on the wind.)
// Reads   c_drag_tau_w, c_drag_row, c_J_w, R_wb. Writes scaled_rate. Runs after composite. O(n), joints in parallel. Errors none.
#pragma once
#include "analytic_state.h"

namespace bough {

template <class T> void joint_drag(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&);
template <class T>
void joint_drag(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, std::size_t body);

} // namespace bough
