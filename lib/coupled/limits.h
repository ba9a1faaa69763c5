// limits.h: joint limits in the coupled step: what a limit's torque does in no time, to the whole tree.
//
// After the step each component of theta stays within its limit, as with the analytic step (joint_limit.h), and the
// components that would push on are stopped without rebound. There a limit's impulse acts on all bodies that hang together: with C
// the set of the components that push, the rates become those nearest to what they were, in the metric of the kinetic energy,
// among those with eta_C = 0:
//   eta += x,  (M + Z) x = -Z eta,  Z = lambda on C, 0 elsewhere, lambda -> infinity
// : one articulated-body pass in real numbers at the step's end, lambda 1e6 (float: 1e3) times the articulated inertia's trace, what that
// leaves of eta_C set to 0. A projection: the bodies' kinetic energy does not grow. (Where several limits act together one of them may be
// held that would have come free. Positions are clamped, which may raise or lower what hangs further out, as in the analytic step.)
// A joint that was stopped is not extrapolated: its last change is dropped. Counted (StepFlags::limited).
// Reads   theta, theta_dot, theta_limit. Writes them, the last changes, and as scratch coupled, resolvent_real. Cost: a
//         comparison a joint, and two sweeps where a limit acts. Errors none; non-finite angles are left as they are.
#pragma once
#include "coupled_state.h"

namespace bough {

// True where a limit acted: the poses are then to be found anew.
template <class T> bool keep_limits(const Plan<T>&, State<T>&, CoupledWork<T>&);

} // namespace bough
