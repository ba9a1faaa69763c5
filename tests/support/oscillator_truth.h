// oscillator_truth.h: one step of the damped oscillator in long double, by the textbook's cases and by quadrature, and the cases in which
// the library's one formula is held against it.
#pragma once
#include <cmath>
#include <vector>

namespace oscillator_truth {

using Real = long double;

struct Solution {
    Real B, C, E;
};

// B by the textbook cases, with the series of sinh(x)/x beside the critical one. E by the two roots, where they are
// apart and away from zero, else by Simpson's rule over B.
inline Real impulse_response(Real b, Real lambda, Real t) {
    const Real g = b / 2, D = g * g - lambda, z = D * t * t;
    if (std::abs(z) < 0.1L) {
        Real sum = 1, term = 1;
        for (int k = 1; k < 14; ++k) sum += term *= z / ((2 * k) * (2 * k + 1));
        return std::exp(-g * t) * t * sum;
    }
    if (D < 0) return std::exp(-g * t) * std::sin(std::sqrt(-D) * t) / std::sqrt(-D);
    const Real mu = std::sqrt(D), slow = lambda > 0 ? -lambda / (g + mu) : mu - g;
    return (std::exp(slow * t) - std::exp(-(g + mu) * t)) / (2 * mu);
}

inline Real step_response(Real b, Real lambda, Real h) {
    const Real x = std::abs(lambda) * h * h, y = b * h;
    if (x < 1 && y < 20) { // Simpson over B, smooth here
        const int n = 4000;
        Real sum = 0;
        for (int k = 0; k <= n; ++k)
            sum += Real(k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * impulse_response(b, lambda, h * k / n);
        return sum * h / (3 * n);
    }
    const Real B = impulse_response(b, lambda, h), g = b / 2, D = g * g - lambda;
    if (x < 1) { // far from critical: integrate both exponentials
        const Real mu = std::sqrt(D), slow = -lambda / (g + mu), fast = -(g + mu);
        const Real grown = slow == 0 ? h : std::expm1(slow * h) / slow;
        return (grown - std::expm1(fast * h) / fast) / (2 * mu);
    }
    const Real z = D * h * h;
    Real C = 0;
    if (std::abs(z) < 0.1L) {
        Real sum = 1, term = 1;
        for (int k = 1; k < 14; ++k) sum += term *= z / ((2 * k) * (2 * k - 1));
        C = std::exp(-g * h) * sum - g * B;
    } else if (D < 0)
        C = std::exp(-g * h) * std::cos(std::sqrt(-D) * h) - g * B;
    else
        C = (std::exp(-(g - std::sqrt(D)) * h) + std::exp(-(g + std::sqrt(D)) * h)) / 2 - g * B;
    return (1 - C - b * B) / lambda;
}

inline Real rate_response(Real b, Real lambda, Real h) { // C = dB/dt, from 1 - lambda E = A = C + b B
    return 1 - lambda * step_response(b, lambda, h) - b * impulse_response(b, lambda, h);
}

struct Case {
    double b, lambda;
};

// In units of 1/h: every damping from none to far over critical, on both sides of critical, and buckling.
inline std::vector<Case> cases() {
    std::vector<Case> all;
    for (double x : {0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.2499, 0.2501, 1.0, 9.0, 100.0, 1e4}) {
        for (double zeta : {0.0, 1e-6, 0.01, 0.5, 0.999, 1 - 1e-8, 1 - 1e-14, 1.0, 1 + 1e-14, 1 + 1e-8, 1.001, 3.0})
            all.push_back({2 * zeta * std::sqrt(x), x});
        for (double y : {1e-9, 1e-3, 0.24, 0.26, 3.0, 50.0}) all.push_back({y, x});
        if (x <= 100)
            for (double y : {0.0, 1e-6, 0.1, 3.0, 50.0}) all.push_back({y, -x});
    }
    return all;
}

} // namespace oscillator_truth
