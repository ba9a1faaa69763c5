// turn_guard.h: the turn from which on a joint's energy is checked (spring.h, "Large turns"). It is a header of its own, so that the SIMD sweeps,
// which know nothing of Eigen, read the same number.
#pragma once

namespace bough {

constexpr double guarded_turn = 0.3; // [rad] of a joint in a step

} // namespace bough
