// turn_bounds.h: how far a step of the coupled solver may turn what it works on. By itself, so that the SIMD sweeps, which know
// nothing of Eigen, read the same numbers.
#pragma once

namespace bough {

// [rad] that a joint turned by in the last step, above which its way on cannot be told (midpoint.h); for its body twice that.
constexpr double extrapolated_turn = 0.15;

// [rad] that a body turns by in a step, from which on the energy guard looks at its tree (energy_guard.h).
constexpr double watched_turn = 0.3;

// And of a leaf, a clump or fruit, whose own balance it looks at.
constexpr double watched_end_turn = 1;

} // namespace bough
