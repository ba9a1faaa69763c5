// air_constants.h: the numbers of air.h, and how foliage folds. They have a header of their own because the SIMD sweeps, which know nothing of Eigen,
// read them too.
#pragma once
#include "kind.h"

namespace bough {

constexpr double cylinder_drag = 1.2, sphere_drag = 0.47, plate_drag = 1.2; // C_d; kappa is half of each
constexpr double streaming_drag = 0.25;                                     // [1] s
constexpr double fold_speed = 7.5;                                          // [m/s]
// Of h: what a clump's leaves keep of their drag as they turn with the wind [1], and the wind at which half of the rest has gone [m/s].
constexpr double streamed = 0.66, stream_speed = 7.2;
constexpr double blade_mean =
    (1 + 2 * streaming_drag) / 3; // [1] a blade's drag over that broadside, mean over all directions
// [1] In the law of a clump whose leaves all face along n, over that of one whose leaves face all ways: of (u.n) n, and what is taken from that of u.
constexpr double facing_along = (1 - streaming_drag) / blade_mean, facing_less = 1 - streaming_drag / blade_mean;
// So c_n + c_u, which bounds a clump's drag in any direction, is 1 + f (analytic_chains.h).
static_assert(facing_along - facing_less > 1 - 1e-12 && facing_along - facing_less < 1 + 1e-12);

// How the drag of foliage falls with the wind (air.h): G, of the force, and d (G |u|) / d |u|.
template <class T> struct Unfolding { T share, slope; };
// speed: [m/s] |u|.
template <class T> constexpr Unfolding<T> unfolding(Kind kind, T speed) {
    if (!is_foliage(kind)) return {T(1), T(1)};
    const T g = 1 / (1 + speed / T(fold_speed));
    if (kind != Kind::clump) return {g, g * g};
    const T x = speed / T(stream_speed), r = 1 / (1 + x * x * (x * x)), h = T(streamed) + T(1 - streamed) * r;
    return {g * h, g * (g * h - T(4 * (1 - streamed)) * r * (1 - r))};
}
static_assert(unfolding(Kind::clump, 8.0).slope > 0 &&
              unfolding(Kind::clump, 9.0).slope > 0); // about where it is least
// The same as lanes take it: g = 1 / (1 + fold |u|), r = 1 / (1 + turn |u|^4); fold is 0 for what does not fold, turn for all but clumps.
template <class T> struct Folds {
    T fold, turn; // [s/m], [s^4/m^4]
};
template <class T> constexpr Folds<T> folds_of(Kind kind) {
    constexpr double square = stream_speed * stream_speed;
    return {is_foliage(kind) ? T(1 / fold_speed) : T(0), kind == Kind::clump ? T(1 / (square * square)) : T(0)};
}

constexpr double blade_turning = 6, clump_turning = 2; // [1] k

} // namespace bough
