// midpoint.h: first sweep of the coupled step (coupled_step.h): where the bodies are half a step on, by extrapolation, how fast they move there, and
// the accelerations that this motion brings by itself.
//
// y* = y0 + (last change of y0) / 2, joint by joint. It is y0 itself for schemes that do not extrapolate, and for joints that turned by more than
// 0.15 rad, or their bodies by more than 0.3 rad, in the last step: their way on cannot be told from it. With twice these bounds a chain in 50 m/s at
// 1/10 s swings on for ever, and clumps on thin twigs flutter in storm: of a birch's frames 1.5 % turn by more than 30 degrees, with these bounds 0.8
// %, with eight steps a frame 0.4 %; of a willow's 1.3, 0.2 and 0 %. Half these bounds change nothing. Outward, G = R_p R_pj:
//   R = G exp theta*,  r = R_p d,  w = G J eta,  omega = omega_p + w,  v = v_p + omega_p x r
//   alpha_0 = alpha_0,p + omega_p x w + G J_dot eta*,  a_0 = a_0,p + alpha_0,p x r + omega_p x (omega_p x r)
//   psi = psi_p + G J (theta* - theta_0)
// v and omega are found twice: with eta* and with eta_0 (omega_0, v_0), both in the pose of y*. The ground is a body whose motion is known: its place
// and velocity half a step on, and for y0 its velocity at the start. Where it jumps within the step the first are the means of both ends, for y* too
// has nothing of what lasts but a moment (the resolvent gives the answer to it). All of it is such that the pivot of its turning moves as in
// ground_course.h: the origin's own motion and the turning about it, large and nearly equal there, leave nothing behind. Quadratic terms take omega
// as a radian a step at most. The step does not resolve what turns faster, and terms that hold for an instant would throw it out. This is counted
// (StepFlags::fast_turns).
// Reads   theta, theta_dot, theta_change, theta_dot_change, CoupledState::ground. Writes the first part of coupled. O(n). Errors none.
#pragma once
#include "coupled_state.h"

namespace bough {

// Writes every spline of root motion over the step from `time` into work.ground.
template <class T> void ground_over_step(const Plan<T>&, const CoupledPlan<T>&, CoupledState<T>&, double time);

// halfway: find the bodies at y*; else at y0, whatever the scheme.
template <class T> void midpoint(const Plan<T>&, State<T>&, CoupledWork<T>&, bool halfway);

// Returns the ground under root i, or null where it rests.
template <class T>
const GroundStep<T>* ground_step_of(const Plan<T>& plan, const CoupledState<T>& work, std::size_t i) {
    const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, i) : -1;
    return spline < 0 ? nullptr : &work.ground[std::size_t(spline)];
}

} // namespace bough
