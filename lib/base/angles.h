// angles.h: a turn and a degree in radians.
#pragma once
#include <numbers>

namespace bough {

constexpr double two_pi = 2 * std::numbers::pi, degree = std::numbers::pi / 180;

} // namespace bough
