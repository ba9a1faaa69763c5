// scheme.h: rational functions that stand for the exponential in the coupled step (coupled_step.h).
//
// A linear system y' = L y + f is advanced by y1 = y0 + h phi1(h L) (L y0 + f), phi1(z) = (exp z - 1) / z. A rational R(z) takes the place of exp z.
// Its poles p are simple and its degree falls at infinity, so
//   phi1(z) = (R(z) - 1) / z = sum over poles of c / (z - p),   c the residue of phi1 at p,
// A complex pole stands for itself and its conjugate: it adds 2 Re. For R = N / D, c = N(p) / (p D'(p)).
// Order q of R: sum of -c / p^(k+1) is 1 / (k + 1)! for k = 0 ... q - 1 (the series of phi1). R(infinity) = 1 + sum of c.
//
//   P12       Pade(1, 2), the stability function of Radau IIA of two stages: order 3, R(infinity) = 0. Hairer, Wanner, Solving
//             Ordinary Differential Equations II, IV.3
//   P.25 P.5  order 3 with R(infinity) = 1/4, 1/2: R = (1 + (1 - b1) z + a2 z^2) / (1 - b1 z + b2 z^2), rho = R(infinity),
//             b1 = (1/3 + rho/6) / (1/2 + rho/2), b2 = b1/2 - 1/6, a2 = 1/3 - b1/2. Less damping, more lag of what is stiff
//   P34       Pade(3, 4), order 7, R(infinity) = 0: two pairs of poles, two solves a step
//   LIE       R = 1 / (1 - z), order 1: the linearly implicit Euler step
// None has |R(infinity)| = 1 (midpoint rule, diagonal Pade). The nonlinear terms would feed undamped, unresolved modes, energy guard or not.
#pragma once
#include <array>
#include <complex>
#include <cstdint>

namespace bough {

enum class Scheme : std::uint8_t { p12, p25, p50, p34, lie };
constexpr std::array<Scheme, 5> all_schemes{Scheme::p12, Scheme::p25, Scheme::p50, Scheme::p34, Scheme::lie};

struct Pole {
    std::complex<double> p, c;
};

struct RationalScheme {
    const char* name;         // as in --scheme
    std::array<Pole, 2> pole; // of a pair of conjugates, the upper
    int poles = 1;            // how many of them count: solves a step
    bool real = false;        // the pole is real and stands for itself alone
    bool extrapolates = true; // the nonlinear terms are taken half a step on (LIE: at the start)
};

const RationalScheme& scheme_of(Scheme);

} // namespace bough
