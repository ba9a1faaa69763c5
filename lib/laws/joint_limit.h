// joint_limit.h: limits of the joints' angles, as the paper enforces them: theta is clamped after its analytic step (§4).
//
// Each component of theta, measured from the spring's rest, stays within its limit. A component that the step took past its limit is set on it. The
// part of its rate that would push on is taken out, without rebound, as an instantaneous torque of the limit would do. That torque acts on the one
// theta component, so it changes w = L^T omega_b (what is carried, spring.h; |w|^2/2 is the joint's kinetic energy) along c = L^-1 T^T e_k alone. So
// w is projected at right angles onto c.w = theta_dot_k = 0, in the metric of the inertia. Zeroing theta_dot_k alone, and keeping the other
// components, could raise |w|. Components that do not push, or that the projection turned back, keep their rate: the one that pushes most is taken
// first, then what still does. Both changes only take energy: |w| falls, |theta_k| falls and with it theta^T K theta / 2. (Gravity's energy may
// differ: the body is held higher or lower than the free step would have left it.) Each joint is treated by itself, as in the whole step: nothing is
// passed to the joints it hangs on or that hang on it.
#pragma once
#include "../base/math.h"

namespace bough {

// limit: [rad], infinite for none. L: S = L L^T at the step's start, lower. Returns true if a component was past its limit. Leaves non-finite angles
// as they are. O(1).
template <class T>
bool stop_at_limit(const Vector3<T>& limit, const Matrix3<T>& L, Vector3<T>& theta, Vector3<T>& scaled_rate);

} // namespace bough
