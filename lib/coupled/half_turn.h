// half_turn.h: what a step carries on for a joint that turned past half a turn: the shorter way round.
#pragma once
#include "../base/math.h"

namespace bough {

// Takes theta [rad] the other way where it is longer than half a turn. The rates [rad/s] become those of the same motion, and the last changes those
// of a motion that begins here (h: the step [s]). Returns false, and changes nothing, where theta is not longer.
template <class T>
bool take_shorter_way(Vector3<T>& theta, Vector3<T>& theta_dot, Vector3<T>& theta_change, Vector3<T>& theta_dot_change,
                      T h) {
    const Vector3<T> long_way = theta;
    if (!shorten_rotation(theta)) return false;
    theta_dot = body_rate_jacobian_inverse(theta) * (body_rate_jacobian(long_way) * theta_dot);
    theta_change = h * theta_dot;
    theta_dot_change.setZero();
    return true;
}

} // namespace bough
