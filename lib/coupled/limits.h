// limits.h: joint limits in the coupled step: the effect of a limit's instantaneous torque on the whole tree.
//
// After the step each component of theta stays within its limit, as with the analytic step (joint_limit.h), and the components that would push on are
// stopped without rebound. Here a limit's impulse acts on all bodies that hang together. With C the set of the components that push, the new rates
// are those with eta_C = 0 that are nearest to the old ones in the metric of the kinetic energy:
//   eta += x,  (M + Z) x = -Z eta,  Z = lambda on C, 0 elsewhere, lambda -> infinity
// This is one articulated-body pass in real numbers at the step's end. lambda is 1e6 (float: 1e3) times the articulated inertia's trace, and what
// that leaves of eta_C is set to 0. It is a projection: the bodies' kinetic energy does not grow. (Where several limits act together, one of them may
// be held that would have come free. Positions are clamped, which may raise or lower what hangs further out, as in the analytic step.) A joint that
// was stopped is not extrapolated: its last change is dropped. It is counted (StepFlags::limited).
// Reads   theta, theta_dot, theta_limit. Writes them, the last changes, and as scratch coupled, resolvent_real. Cost: a comparison a joint, and two
//         sweeps where a limit acts. Errors none; non-finite angles are left as they are.
#pragma once
#include "coupled_state.h"

namespace bough {

// Returns true if a limit acted; the poses must then be found anew.
template <class T> bool keep_limits(const Plan<T>&, State<T>&, CoupledWork<T>&);

} // namespace bough
