// turn.h: rotations and random variation as growth writes them; private to growth. Angles in radians.
#pragma once
#include "../base/angles.h"
#include "../base/math.h"
#include "random.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bough {

// Rotation about an axis of length 1.
inline Quat about(const Vec3& axis, double angle) {
    return quaternion_from_vector<double>(axis * angle);
}
inline Quat about_x(double angle) {
    return about(Vec3::UnitX(), angle);
}
inline Quat about_y(double angle) {
    return about(Vec3::UnitY(), angle);
}
inline Quat about_z(double angle) {
    return about(Vec3::UnitZ(), angle);
}

// Angle between a stem (z of its frame) and the vertical.
inline double declination(const Quat& frame) {
    return std::acos(std::clamp((frame * Vec3::UnitZ()).y(), -1.0, 1.0));
}

// value + v u with u uniform in -1..1.
template <class Name> double varied(double value, double v, RandomKey key, Name draw, std::uint64_t index = 0) {
    return value + v * random_sign(key, draw, index);
}

} // namespace bough
