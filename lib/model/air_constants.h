// air_constants.h: the numbers of air.h, and how foliage folds. They have a header of their own because the SIMD sweeps, which know nothing of Eigen,
// read them too.
#pragma once

namespace bough {

constexpr double cylinder_drag = 1.2, sphere_drag = 0.47, plate_drag = 1.2; // C_d; kappa is half of each
constexpr double streaming_drag = 0.25;                                     // [1] s
constexpr double fold_speed = 7.5;                                          // [m/s] for the two functions below
constexpr double blade_mean =
    (1 + 2 * streaming_drag) / 3; // [1] a blade's drag over that broadside, mean over all directions
// [1] In the law of a clump whose leaves all face along n, over that of one whose leaves face all ways: of (u.n) n, and what is taken from that of u.
constexpr double facing_along = (1 - streaming_drag) / blade_mean, facing_less = 1 - streaming_drag / blade_mean;
// So c_n + c_u, which bounds a clump's drag in any direction, is 1 + f (analytic_chains.h).
static_assert(facing_along - facing_less > 1 - 1e-12 && facing_along - facing_less < 1 + 1e-12);

// [1] Returns 1 / g of air.h at this speed [m/s].
template <class T> constexpr T folding(T speed) {
    return 1 + speed / T(fold_speed);
}
// [s/m] Returns the fold with which g is 1 / (1 + fold |u|), as lanes take it: 0 for what does not fold.
template <class T> constexpr T fold_where(bool folds) {
    return folds ? T(1 / fold_speed) : T(0);
}

constexpr double blade_turning = 6, clump_turning = 2; // [1] k

} // namespace bough
