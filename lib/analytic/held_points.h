// held_points.h: springs and dampers of any stiffness between points of bodies and points in space, or of other bodies (Attachment, scene.h), in the
// analytic step.
//
// Each joint steps by itself (spring.h), and a spring at a point couples all joints between it and the ground. But what a joint turns by in a step is known
// in closed form, and linear in a moment tau that is held over the step: phi_j = phi_j0 + E_j tau, E_j = U diag(E) U^T (oscillator.h), symmetric and
// never negative. So is the way of the point, with e its distance to the target (of a pair: to the other point, less the target), 0 and 1 the step's ends:
//   e_1 - e_0 = d + W f,   d without f, less the target's own way,   W = sum over the path's joints of [rho_j]^T E_j [rho_j]
// and the force f, held over the step, is the one that belongs to where it moves the point:
//   f = -k (e_0 + a (e_1 - e_0)) - (c/h) (e_1 - e_0),   i.e.   (1/kappa + W) f = -(k/kappa) e_0 - d,   kappa = a k + c/h
// Three equations an attachment, one solve for all: joints that attachments share, and loops that pairs close, are in W. With the target at rest and
// the arms rho as they are at the step's start, the step's joints and spring lose the energy (a - 1/2) k |e_1 - e_0|^2 + (c/h) |e_1 - e_0|^2: the work
// f.(e_1 - e_0) is what the oscillators have gained, exactly. So for a >= 1/2 no k, no c and no step gains any, however many joints there are.
//   a = 1/2 + s/2,   s = (z/(4 + z))^2,   z = (k h^2 + c h) tr(V)/3,   V = sum [rho_j]^T S_j^-1 [rho_j]
// is of second order where the spring is soft to the step, and where k is beyond all else takes the point to its target.
// There the point's velocity would change its sign each step, as its mean is the target's. At the step's end, so,
//   (1/g + V) P = X' - x',   g = s (h^2 k + h c)/2
// is the impulse of a damper g/h, taken implicitly: it takes kinetic energy, and vanishes with the third order of the step.
//
// Direction. Joints that turn change the arms: the Hessian of -f.x, block diagonal in the bodies' absolute rotations, |H_b| <= |f| |P_b|, P_b from the
// body's joint to the path's next, or to the point (coupled/attachment.h). By Cauchy's inequality the joints' own
//   gamma_j = F sum over the path's bodies b from j on of |P_b| n_b,   n_b the joints from the ground to b
// bounds it, and stands beside K in the joint's oscillator as gravity's does; at first order of the step it changes nothing, and no fixed point. F is
// the larger of the last step's |f| and w |f|, w the square of the largest turn that the change of f asks of a joint, over 0.1 rad, at most 1: found by making
// F larger until it is. The price: a path that is drawn tight, to what is beyond its reach, straightens as slowly as that.
//
// Carried from step to step: f. All but the joints' own steps in double. Reads composites, theta, scaled_rate, R_wb; writes held_tau_w, held_row of the
// bodies on paths, after the spring their theta_dot and scaled_rate.
// After composite, drag, root_loads, fictitious_torques; before and after spring. O(3 attachments x paths) + O((3 attachments)^3); a joint is worked out
// once more than without. A step allocates nothing. Errors none.
#pragma once
#include "analytic_state.h"

namespace bough {

// The plan's, at the start pose. O(paths).
template <class T> HeldPoints<T> planned_held(const Plan<T>&);
// Those on bodies that have broken off go.
template <class T> void release_held(const Plan<T>&, AnalyticWork<T>&, const std::vector<std::size_t>& bodies);

// The forces of the step from `time` [s], as moments about the joints that bear them.
template <class T>
void hold_points(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, AnalyticWork<T>&, double time);
// Once the joints have stepped: the impulses at its end.
template <class T> void slow_held(const Plan<T>&, State<T>&, AnalyticWork<T>&);

} // namespace bough
