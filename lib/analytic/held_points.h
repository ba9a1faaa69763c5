// held_points.h: springs and dampers of any stiffness in the analytic step, between points of bodies and points in space or of other bodies
// (Attachment, scene.h).
//
// Each joint steps by itself (spring.h), and a spring at a point couples all joints between it and the ground. But a joint's turn in a step is known
// in closed form, and is linear in a moment tau that is held over the step: phi_j = phi_j0 + E_j tau, E_j = U diag(E) U^T (oscillator.h), symmetric
// and never negative. So is the way of the point. With e its distance to the target (of a pair: to the other point, less the target), and 0 and 1 the
// step's ends:
//   e_1 - e_0 = d + W f,   d without f, less the target's own way,   W = sum over the path's joints of [rho_j]^T E_j [rho_j]
// The force f, held over the step, is the one that belongs to where it moves the point:
//   f = -k (e_0 + a (e_1 - e_0)) - (c/h) (e_1 - e_0),   i.e.   (1/kappa + W) f = -(k/kappa) e_0 - d,   kappa = a k + c/h
// These are three equations an attachment, with one solve for all: W holds joints that attachments share, and loops that pairs close. With the target
// at rest and the arms rho as at the step's start, the step's joints and spring lose the energy (a - 1/2) k |e_1 - e_0|^2 + (c/h) |e_1 - e_0|^2,
// since the oscillators gain exactly the work f.(e_1 - e_0). So for a >= 1/2 no k, no c and no step gains any, however many joints there are.
//   a = 1/2 + s/2,   s = (z/(4 + z))^2,   z = (k h^2 + c h) tr(V)/3,   V = sum [rho_j]^T S_j^-1 [rho_j]
// This is of second order where the spring is soft to the step, and takes the point to its target where k is beyond all else. There the point's
// velocity would change its sign each step, as its mean is the target's. So at the step's end
//   (1/g + V) P = X' - x',   g = s (h^2 k + h c)/2
// is the impulse of a damper g/h, taken implicitly. It takes kinetic energy, and vanishes with the third order of the step.
//
// Direction. Joints that turn change the arms, by the Hessian of -f.x. It is block diagonal in the bodies' absolute rotations, |H_b| <= |f| |P_b|,
// with P_b from the body's joint to the path's next, or to the point (coupled/attachment.h). By Cauchy's inequality the joints' own
//   gamma_j = F sum over the path's bodies b from j on of |P_b| n_b,   n_b the joints from the ground to b
// bounds it, and stands beside K in the joint's oscillator as gravity's does. At first order of the step it changes nothing, and it moves no fixed
// point. F is the larger of the last step's |f| and w |f|. w is the square of the largest turn that the change of f asks of a joint, over 0.1 rad, at
// most 1. It is found by making F larger until it is so. The price is that a path which is drawn tight, to what is beyond its reach, straightens as
// slowly as that.
//
// f is carried from step to step. All but the joints' own steps are in double. Reads composites, theta, scaled_rate, R_wb. Writes held_tau_w and
// held_row of the bodies on paths, and after the spring their theta_dot and scaled_rate. Runs after composite, drag, root_loads, fictitious_torques;
// before and after spring. O(3 attachments x paths) + O((3 attachments)^3); each joint is worked out once more than without. A step allocates
// nothing. Errors none.
#pragma once
#include "analytic_state.h"

namespace bough {

// Sets up the plan's attachments at the start pose. O(paths).
template <class T> HeldPoints<T> planned_held(const Plan<T>&);
// Drops those on bodies that have broken off.
template <class T> void release_held(const Plan<T>&, AnalyticWork<T>&, const std::vector<std::size_t>& bodies);

// Finds the forces of the step from `time` [s], as moments about the joints that bear them.
template <class T>
void hold_points(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, AnalyticWork<T>&, double time);
// Finds the impulses at the step's end, once the joints have stepped.
template <class T> void slow_held(const Plan<T>&, State<T>&, AnalyticWork<T>&);

} // namespace bough
