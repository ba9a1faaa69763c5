// extrapolation.h: solutions of the articulated dynamics of high order, with their own error estimate: what every other
// solver is held against.
//
// Step. Over H the linearly implicit Euler step (articulated_step.h) is taken with h = H / j, j = 1..8. Its error has an
// expansion in powers of h (a one-step method with smooth coefficients; Hairer, Norsett, Wanner, Solving Ordinary
// Differential Equations I, II.8; stiff: II, IV.9), so Aitken and Neville's table
//   T_j,k+1 = T_j,k + (T_j,k - T_j-1,k) / (j / (j - k) - 1)
// cancels one power a column: T_8,8 is of order 8, and stiff components stay as stable as the implicit step makes them.
// The sequences are independent of one another and run in parallel.
// Error. e = RMS over the joints of |T_8,8 - T_8,7|, the larger of theta's [rad] and rate's times H; accepted where e <= tolerance,
// and the next is H (tolerance / e)^(1/8), times 0.8, between 1/4 and 2.5 of it. It is the error of the column before the
// last, so an overestimate where the table converges.
// A step of the plan (its dt) is cut into as many H as that takes; the last is shortened to end with it. The proposal for
// the next goes on in ArticulatedState::inner_step, which a saved state keeps: a run cut in two is the same.
// Reads   theta, rate in the state (State::theta, ArticulatedState::rate). Writes them. 36 passes an H. Allocates nothing.
// No H reaches over a key of a moving ground (quintic.h): its fifth derivative jumps there, which the expansion does not have, and all rows
// would step over a jump that is short beside H / 8.
// A tolerance holds for one H, in the angle and in H times the rate: over many H the angle's error grows to about
// tolerance (time / H)^2 where nothing damps it.
// Errors  where e is above the tolerance but only rounding (4096 roundings of the largest theta and H rate: the weights of the
//         table's last row sum to 3400), and where H falls below 1e-9 of the plan's step (non-finite), it goes on with that H
//         and counts it (StepFlags::unresolved): the result is then no reference, and users are told.
#pragma once
#include "articulated.h"

namespace bough {

constexpr int extrapolation_rows = 8;

// One step of plan.dt from time `time`.
void extrapolated_step(const Plan<double>&, const ArticulatedPlan&, State<double>&, ArticulatedState&, double time);

} // namespace bough
