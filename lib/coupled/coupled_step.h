// coupled_step.h: bough's own step: the full dynamics of the articulated tree, one linear solve a step, O(n).
//
// Equation. In every joint's rotation vector theta and eta = theta_dot the tree obeys y' = f(y, t), y = (theta, eta):
//   theta' = eta,   M(theta) eta' = -K (theta + beta eta) + Q(theta, eta, t)
// M is the joint-space inertia, Q all else: gravity, air, pulls, the moving ground and the terms from the turning of bodies. In this chart the
// springs are exactly linear (articulated.h says why this is the spring law).
//
// Step. For any matrix L, y' = L y + (f(y, t) - L y). The bracket is taken as constant at a point y* half a step on, and the rest is solved exactly
// (an exponential Rosenbrock step: Hochbruck, Ostermann, Acta Numerica 19, 2010, 2.4; any L: W-methods, Verwer et al. 1999):
//   y1 = y0 + h phi1(h L) f~,   f~ = f(y*, t*) + L (y0 - y*)
// phi1 is replaced by a rational function (scheme.h; Haut et al. 2016 for the idea): y1 = y0 + h sum c (h L - p)^-1 f~ over its poles. With
//   L = ( 0 1 ; -M*^-1 (K + H)  -M*^-1 (K beta + D) ),   f~ = (eta_0, M*^-1 (-K (theta_0 + beta eta_0) + Q* + H psi* + D (eta* - eta_0)))
// (* is at y*; H and D are what of Q's derivatives is linear and known: gravity's and the air's), (h L - p)(x_u, x_v) = f~ reads
//   h x_v - p x_u = eta_0,   -h M^-1 ((K + H) x_u + (K beta + D) x_v) - p x_v = f~_eta
// Eliminating x_u = (h x_v - eta_0)/p gives, with s = p/h and the acceleration gamma = -p x_v,
//   (M + (K beta + D)/s + (K + H)/s^2) gamma = M f~_eta - (K + H) eta_0/s
// This is one solve with the tree's inertia at the complex frequency s. resolvent.h makes it an articulated-body pass.
// Known functions of time change within the step: the wind, pulls, and the ground's acceleration by its two integrals over the step
// (ground_course.h). Exactly linear ones add h phi2 to h phi1 at the middle value. phi2's residue is c/p, so the right side has f(t*) + (1/p -
// 1/2)(f(t + h) - f(t)). For LIE, p = 1, this is the force at the end. For the ground LIE takes the mean, since its slope can be a pair of impulses,
// which no step of order 1 can tell from one.
//
// Order. y* = y0 + (last change)/2 is y(t + h/2) to second order. So the order is 2 for any L and any of the schemes except LIE, which takes y* = y0.
// Where a joint's motion was broken off (start, joint limit, half turn, a jump of the ground) the last change is h eta, 0.
// Thin twigs in wind turn by 0.3 to 0.6 rad a step; there the error falls with h^0.9 from one to four steps a frame (lib/study/README.md). Tried on
// bare apple, willow and oak of 400 bodies, one step of 1/30 s, RMS error of the tips in gusty wind / storm (with y* up to turns of 0.3 rad 6.6, 5.9,
// 7.1 / 22, 14, 8.4 %):
//   the step again with y* from its own result               5.3, 4.0, 7.0 / 11, 12, 6.7     twice the cost
//   the same, twice                                          5.0, 3.4, 6.7 / 11, 8.7, 5.7    three times: the limit of one evaluation a step
//   the slope of transmitted drag, r x F turned with the body  4.7, 6.4, 8.9 / 23, 15, 14
//   the same with the body's own drag, and its direction     13, 9.8, 11 / 31, 37, 25
//   two steps                                                3.7, 2.4, 4.2 / 10, 8.1, 4.6    twice: what a user takes where it matters
// Error of the linear part. A mode at omega is advanced by R(i omega h): P12 damps it by (omega h)^3 / 72 and is exact to h^3.
// Reads and writes State and CoupledState. theta, theta_dot, and their last changes are carried.
#pragma once
#include "coupled_state.h"

namespace bough {

// Advances the state by plan.dt. Needs a state of this plan with kinematics up to date. O(n), allocates nothing. (coupled/coupled_lanes_step.h does
// the same in SIMD lanes.)
template <class T>
void coupled_step(const Plan<T>&, const CoupledPlan<T>&, State<T>&, CoupledWork<T>&, StageClock* clock);

} // namespace bough
