// rational.h: the coupled step's rational functions as quotients of polynomials, from their definitions: no poles, no residues.
#pragma once
#include "lib/coupled/scheme.h"
#include <vector>

namespace rational {

// Coefficients of R = N / D, rising powers.
struct Function {
    std::vector<long double> N, D;
};

inline Function of(bough::Scheme scheme) {
    const auto third_order = [](long double rho) {
        const long double b1 = (1 / 3.0L + rho / 6) / (0.5L + rho / 2), b2 = b1 / 2 - 1 / 6.0L, a2 = 1 / 3.0L - b1 / 2;
        return Function{{1, 1 - b1, a2}, {1, -b1, b2}};
    };
    switch (scheme) {
    case bough::Scheme::p12:
        return third_order(0);
    case bough::Scheme::p25:
        return third_order(0.25L);
    case bough::Scheme::p50:
        return third_order(0.5L);
    case bough::Scheme::p34:
        return {{1, 3 / 7.0L, 1 / 14.0L, 1 / 210.0L}, {1, -4 / 7.0L, 1 / 7.0L, -2 / 105.0L, 1 / 840.0L}};
    case bough::Scheme::lie:
        break;
    }
    return {{1}, {1, -1}};
}

} // namespace rational
