// body_load.h: second part of the coupled step (coupled_step.h): each body's own inertia, forces and what they change by.
//
// At y*, with f the air's force and pulls, D = -d f / d v, H = -d (moment) / d (rotation), all about the joint:
//   F = m (a_0 - g + alpha_0 x c + omega x (omega x c)) - f*
//   N = J alpha_0 + omega x J omega + m c x (a_0 - g) - c x f* - H psi,      f* = f(y*) + D (v* - v_0) at the centre of mass
// so that f* and the moment H psi stand for the force at y0's velocity and rotation in the linear model at y*; what they change by on the way
// is the resolvent's. H has two parts. Gravity's: turning the tree by psi_b body by body changes its moments by the Hessian
// of its potential, which is block diagonal in the bodies' absolute rotations (the body's first moment is that of
// all it carries: P = R (m c + sum over children of (mass outboard) d), a constant in the body's axes):
//   H = (P.g) 1 - (P g^T + g P^T) / 2
// The air's: what the drag of all that the body carries, streaming with the wind, resists its turning by (air.h). Without it ends that stream in a
// storm, where drag is twenty times their weight, flutter at one step a frame, and the tree stands too straight: a birch of 1 000 bodies in
// steady 35 m/s leaned by 0.47 m instead of 0.52 m. On plates also the bound of air.h on how fast their moment may turn, and leaf_air.h's where
// there is /leaves, which brings to N its torque too. What the air takes of a body's own turning, spin I omega, is in N at omega_0, as its change is
// the resolvent's.
// (What it makes that the points of pulls go with their bodies: pulled_points.h.)
// slope: known functions of time, the wind's velocity U and the pulls: D (U(t+h) - U(t)), f(t+h) - f(t).
// Torque of the joint, world: rates^T (-K (theta_0 + beta eta_0)), and rates^T K eta_0 its rate.
// Reads   the first part of coupled, theta, theta_dot, wind, wind_change. Writes the second. O(n), bodies in parallel. Errors none.
#pragma once
#include "coupled_state.h"

namespace bough {

template <class T> void body_loads(const Plan<T>&, const CoupledPlan<T>&, State<T>&, CoupledWork<T>&, double time);

// Wind half a step on, and its change over the step, into state.wind, work.wind_change (or wind_start, wind_end). O(its tables).
template <class T> void wind_over_step(const Plan<T>&, State<T>&, CoupledState<T>&, double time);

} // namespace bough
