// eztree_rotation.h: the rotations of three.js that ez-tree turns its branches with, formula for formula. Private to growth.
#pragma once
#include "../base/math.h"

namespace bough::three {

// Euler angles in the order XYZ, [rad].
Quat from_euler(const Vec3&);
Vec3 to_euler(const Quat&);
// The shorter way from a (t = 0) to b (t = 1); t beyond goes on.
Quat slerp(const Quat& a, const Quat& b, double t);
// a turned toward b by `step` [rad], never past it; negative: away, without a bound.
Quat rotate_towards(const Quat& a, const Quat& b, double step);
// The rotation that takes +y to `to`, as three.js has it for a `to` of any length.
Quat y_to(const Vec3& to);

} // namespace bough::three
