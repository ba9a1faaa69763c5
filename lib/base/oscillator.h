// oscillator.h: one step of q'' + b q' + lambda q = f in closed form, (6): one smooth formula through every case.
//
//   q_new = q + E r + B v        v_new = B r + C v        r = f - lambda q: the residual force at the start of the step
//
// With g = b/2, D = g^2 - lambda, mu = sqrt|D| and r1, r2 = -g +- mu the roots:
//   D < 0   B = e^(-g h) sin(mu h)/mu                        C = e^(-g h) cos(mu h) - g B
//   D >= 0  B = e^(r1 h) (1 - e^(-2 mu h)) / (2 mu)          C = e^(r2 h) + r1 B,  r1 = -lambda/(g + mu): no cancellation
//   E = integral of B over the step = (1 - A)/lambda, A = C + b B, as a power series where lambda h^2 and b h are small.
// This is A q + B v + E f written with 1 - A = lambda E. f and lambda q, large and nearly equal for a stiff spring, are never subtracted here. A
// joint in equilibrium (r = 0, v = 0) stays exactly where it is. lambda = 0 (free) and lambda < 0 (buckling: it grows as cosh) need no case of their
// own.
// Reads   b >= 0 [1/s], lambda [1/s^2], h > 0 [s]. Cost O(1). Errors none; e^(r1 h) overflows to infinity where a buckling joint really grows by that
//         much in one step.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace bough {

template <class T> struct Propagator { T B, C, E; };

// Returns the largest lambda that is not bounded: above it g^2 would overflow. A bounded oscillator rings (or, damped, creeps with -1/beta) far
// faster than any step, so the bound is not visible in a result. It is counted all the same.
template <class T> constexpr T largest_lambda() {
    return sizeof(T) == 4 ? T(1e16) : T(1e150);
}

template <class T> Propagator<T> propagate(T b, T lambda, T h) {
    const T g = b / 2;
    const T D = g * g - lambda;
    const T mu = std::sqrt(std::max(std::abs(D), std::numeric_limits<T>::min()));
    Propagator<T> p;
    T r1 = 0;
    if (D < 0) {
        const T decay = std::exp(-g * h);
        p.B = decay * std::sin(mu * h) / mu;
        p.C = decay * std::cos(mu * h) - g * p.B;
    } else {
        r1 = -lambda / (g + mu);
        p.B = std::exp(r1 * h) * (-std::expm1(-2 * mu * h) / (2 * mu));
        p.C = std::exp(-(g + mu) * h) + r1 * p.B;
    }
    const T x = lambda * h * h, y = b * h;
    if (std::abs(x) + y < T(0.25)) {
        // The Taylor series of the solution that starts at rest under a unit force, in units of the step.
        T a1 = 0, a2 = T(0.5), a0 = 0, sum = a2;
        for (int k = 1; k < 14; ++k) {
            a0 = a1;
            a1 = a2;
            a2 = -(y * T(k + 1) * a1 + x * a0) / T((k + 2) * (k + 1));
            sum += a2;
        }
        p.E = h * h * sum;
    } else if (D < 0) {
        p.E = (1 - (p.C + b * p.B)) / lambda;
    } else {
        const T grown = r1 == 0 ? h : std::expm1(r1 * h) / r1;
        p.E = (grown - p.B) / (g + mu);
    }
    return p;
}

} // namespace bough
