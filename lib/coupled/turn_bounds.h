// turn_bounds.h: how far a step of the coupled solver may turn what it works on. It is a header of its own, so that the SIMD sweeps, which know
// nothing of Eigen, read the same numbers.
#pragma once

namespace bough {

// [rad] A joint's turn in the last step, above which its way on cannot be told (midpoint.h). For its body it is twice that.
constexpr double extrapolated_turn = 0.15;

// [rad] A body's turn in a step, from which on the energy guard looks at its tree (energy_guard.h).
constexpr double watched_turn = 0.3;

// [rad] The same for a leaf, a clump or fruit, whose own balance the guard looks at.
constexpr double watched_end_turn = 1;

} // namespace bough
