// The rational functions of scheme.h, rebuilt from poles and residues, against their closed forms, orders and bounds.
#include "tests/support/rational.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

using namespace bough;
using Z = std::complex<double>;

namespace {

// Over all poles, the conjugates of a complex one too.
template <class F> Z over_poles(const RationalScheme& scheme, F term) {
    Z sum = 0;
    for (int k = 0; k < scheme.poles; ++k) {
        const Pole& pole = scheme.pole[std::size_t(k)];
        sum += term(pole.p, pole.c);
        if (!scheme.real) sum += term(std::conj(pole.p), std::conj(pole.c));
    }
    return sum;
}

Z phi1(const RationalScheme& scheme, Z z) {
    return over_poles(scheme, [z](Z p, Z c) { return c / (z - p); });
}
Z R(const RationalScheme& scheme, Z z) {
    return 1.0 + z * phi1(scheme, z);
}

Z closed_form(Scheme scheme, Z z) {
    const rational::Function r = rational::of(scheme);
    const auto value = [z](const std::vector<long double>& c) {
        Z sum = 0;
        for (std::size_t k = c.size(); k-- > 0;) sum = sum * z + double(c[k]);
        return sum;
    };
    return value(r.N) / value(r.D);
}

int order_of(Scheme scheme) {
    switch (scheme) {
    case Scheme::p12:
    case Scheme::p25:
    case Scheme::p50:
        return 3;
    case Scheme::p34:
        return 7;
    case Scheme::lie:
        break;
    }
    return 1;
}

double at_infinity(Scheme scheme) {
    switch (scheme) {
    case Scheme::p25:
        return 0.25;
    case Scheme::p50:
        return 0.5;
    default:
        return 0;
    }
}

// Damping of |R(iy)| below 1 that doubles cannot tell from none.
constexpr double rounding = 1e-14;

} // namespace

TEST_CASE("Each scheme has its order's series of phi1, and not the next term") {
    for (const Scheme scheme : all_schemes) {
        const RationalScheme& s = scheme_of(scheme);
        CAPTURE(s.name);
        double factorial = 1;
        for (int k = 0; k <= order_of(scheme); ++k) {
            factorial *= k + 1;
            const Z term = over_poles(s, [k](Z p, Z c) { return -c / std::pow(p, k + 1); });
            CAPTURE(k);
            if (k < order_of(scheme))
                CHECK(std::abs(term * factorial - 1.0) < 1e-13 * factorial);
            else
                CHECK(std::abs(term * factorial - 1.0) > 1e-4);
        }
    }
}

TEST_CASE("R tends to the stated value at infinity") {
    for (const Scheme scheme : all_schemes) {
        const RationalScheme& s = scheme_of(scheme);
        CAPTURE(s.name);
        const Z limit = 1.0 + over_poles(s, [](Z, Z c) { return c; });
        CHECK(std::abs(limit - at_infinity(scheme)) < 1e-13);
        CHECK(std::abs(R(s, Z(-1e7, 0)) - at_infinity(scheme)) < 1e-5);
    }
}

TEST_CASE("No scheme amplifies an undamped mode, at any frequency") {
    for (const Scheme scheme : all_schemes) {
        const RationalScheme& s = scheme_of(scheme);
        CAPTURE(s.name);
        double most = 0;
        for (double y = 1e-4; y <= 1e4; y *= 1.001) most = std::max(most, std::abs(R(s, Z(0, y))));
        CHECK(most <= 1 + rounding);
        CHECK(std::abs(R(s, 0) - 1.0) == 0);
        // Analytic on the left: with the bound on its edge, A-stable.
        for (int k = 0; k < s.poles; ++k) CHECK(s.pole[std::size_t(k)].p.real() > 0);
    }
}

TEST_CASE("R is the closed form: Pade (1,2), Pade (3,4), the family of order 3 and Euler's") {
    for (const Scheme scheme : all_schemes) {
        const RationalScheme& s = scheme_of(scheme);
        CAPTURE(s.name);
        for (const Z z : {Z(0.1, 0), Z(-1, 2), Z(0, -7), Z(-30, 4), Z(1.5, -0.5), Z(-0.02, 300)}) {
            CAPTURE(z);
            CHECK(std::abs(R(s, z) - closed_form(scheme, z)) < 1e-13 * (1 + std::abs(z)));
        }
    }
    // Pade's own definition: the error starts at z^(m + n + 1) with m! n! / ((m + n)! (m + n + 1)!).
    const auto leading = [](Scheme scheme, int power) { // by the mean over a circle, which leaves the first term alone
        Z sum = 0;
        for (int k = 0; k < 64; ++k) {
            const Z z = std::polar(0.5, 0.098174770424681035 * k);
            sum += (std::exp(z) - closed_form(scheme, z)) / std::pow(z, power) / 64.0;
        }
        return std::abs(sum);
    };
    CHECK(leading(Scheme::p12, 4) == Approx(2.0 / (6 * 24)).epsilon(1e-5));
    CHECK(leading(Scheme::p34, 8) == Approx(6.0 * 24 / (5040.0 * 40320)).epsilon(1e-5));
}

TEST_CASE("P12 damps a mode by (omega h)^3 / 72 of a radian") {
    const double y = 2 * 3.14159265358979323846 / 30; // 1 Hz at 1/30 s
    const double ratio = -std::log(std::abs(R(scheme_of(Scheme::p12), Z(0, y)))) / y;
    CHECK(ratio == Approx(y * y * y / 72).epsilon(0.02));
}

TEST_CASE("Schemes are found by number, and named apart") {
    std::vector<std::string> names;
    for (const Scheme scheme : all_schemes) {
        const std::string name = scheme_of(scheme).name;
        CHECK(std::find(names.begin(), names.end(), name) == names.end());
        names.push_back(name);
        CHECK(scheme_of(scheme).extrapolates == (scheme != Scheme::lie));
    }
}
