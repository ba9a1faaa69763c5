// body_load.h: second part of the coupled step (coupled_step.h): each body's own inertia, the forces on it, and how they change.
//
// At y*, with f the force of the air and the pulls, D = -d f / d v, H = -d (moment) / d (rotation), all about the joint:
//   F = m (a_0 - g + alpha_0 x c + omega x (omega x c)) - f*
//   N = J alpha_0 + omega x J omega + m c x (a_0 - g) - c x f* - H psi,      f* = f(y*) + D (v* - v_0) at the centre of mass
// So f* and the moment H psi stand for the force at y0's velocity and rotation in the linear model at y*; the resolvent adds how they change on the
// way. H has two parts. The first is gravity's. Turning the tree by psi_b body by body changes its moments by the Hessian of its potential, which is
// block diagonal in the bodies' absolute rotations. (The body's first moment is that of all it carries: P = R (m c + sum over children of (mass
// outboard) d), a constant in the body's axes.)
//   H = (P.g) 1 - (P g^T + g P^T) / 2
// The second is the air's: how the drag of all that the body carries, streaming with the wind, resists the body's turning (air.h). Without it ends
// that stream in a storm, where drag is twenty times their weight, flutter at one step a frame, and the tree stands too straight: a birch of 1 000
// bodies in steady 35 m/s leaned by 0.47 m instead of 0.52 m. Plates also have the bound of air.h on how fast their moment may turn, and with /leaves
// that of leaf_air.h, whose torque joins N too. The air takes spin I omega of a body's own turning: N has it at omega_0, as the resolvent has its
// change. (pulled_points.h has the effect of the points of pulls going with their bodies.)
// slope: known functions of time, the wind's velocity U and the pulls: D (U(t+h) - U(t)), f(t+h) - f(t). The torque of the joint, world, is rates^T
// (-K (theta_0 + beta eta_0)), and its rate is rates^T K eta_0.
// Reads   the first part of coupled, theta, theta_dot, wind, wind_change. Writes the second. O(n), bodies in parallel. Errors none.
#pragma once
#include "coupled_state.h"

namespace bough {

template <class T> void body_loads(const Plan<T>&, const CoupledPlan<T>&, State<T>&, CoupledWork<T>&, double time);

// Writes the wind half a step on into state.wind, and its change over the step into work.wind_change (or wind_start, wind_end). O(its tables).
template <class T> void wind_over_step(const Plan<T>&, State<T>&, CoupledState<T>&, double time);

} // namespace bough
