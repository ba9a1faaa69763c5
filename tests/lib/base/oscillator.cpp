// One step of the damped oscillator against its closed forms in long double, and against Runge-Kutta.
#include "lib/base/oscillator.h"
#include "tests/support/oscillator_truth.h"
#include <catch2/catch.hpp>
#include <complex>
#include <vector>

using namespace bough;

namespace {

using namespace oscillator_truth;
using Wide = Real;

} // namespace

TEST_CASE("propagate is the closed form in every case of damping") {
    for (const double h : {1.0, 1.0 / 30, 1e-3})
        for (const Case& c : cases()) {
            const double b = c.b / h, lambda = c.lambda / (h * h);
            CAPTURE(h, c.b, c.lambda);
            const Propagator<double> p = propagate(b, lambda, h);
            const Wide B = impulse_response(b, lambda, h), C = rate_response(b, lambda, h),
                       E = step_response(b, lambda, h);
            // An oscillation passes through zero: its error is relative to its amplitude there.
            const Wide ring = lambda > 0 ? 1 / std::sqrt(Wide(lambda)) : Wide(0);
            CHECK(std::abs(Wide(p.B) - B) <=
                  1e-12L * std::max(std::abs(B), std::min(ring, Wide(h)) * std::exp(-b * h / 2)));
            CHECK(std::abs(Wide(p.C) - C) <= 1e-12L * std::max(std::abs(C), Wide(1)));
            CHECK(std::abs(Wide(p.E) - E) <= 1e-12L * std::abs(E));
        }
}

TEST_CASE("E lambda is 1 - A") {
    for (const Case& c : cases()) {
        CAPTURE(c.b, c.lambda);
        const Propagator<double> p = propagate(c.b, c.lambda, 1.0);
        const double A = p.C + c.b * p.B;
        CHECK(std::abs(p.E * c.lambda - (1 - A)) <= 1e-13 * std::max({1.0, std::abs(A), c.b * p.B}));
    }
}

TEST_CASE("a step is what Runge-Kutta finds in many small ones") {
    for (const Case& c : cases()) {
        if (std::abs(c.lambda) > 100 || c.b > 10) continue;
        CAPTURE(c.b, c.lambda);
        const double q0 = 0.7, v0 = -1.3, f = 2.1;
        double q = q0, v = v0;
        const int n = 4000;
        const double dt = 1.0 / n;
        const auto force = [&](double x, double w) { return f - c.b * w - c.lambda * x; };
        for (int k = 0; k < n; ++k) {
            const double v1 = v, a1 = force(q, v);
            const double v2 = v + dt / 2 * a1, a2 = force(q + dt / 2 * v1, v2);
            const double v3 = v + dt / 2 * a2, a3 = force(q + dt / 2 * v2, v3);
            const double v4 = v + dt * a3, a4 = force(q + dt * v3, v4);
            q += dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
            v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        }
        const Propagator<double> p = propagate(c.b, c.lambda, 1.0);
        const double r = f - c.lambda * q0;
        CHECK(q0 + p.E * r + p.B * v0 == Approx(q).epsilon(1e-9).margin(1e-9));
        CHECK(p.B * r + p.C * v0 == Approx(v).epsilon(1e-9).margin(1e-8));
    }
}

TEST_CASE("what rests in equilibrium stays exactly") {
    const Propagator<double> p = propagate(0.3, 1e8, 1.0 / 30);
    const double f = 3.7e8, q = f / 1e8;
    CHECK(q + p.E * (f - 1e8 * q) + p.B * 0.0 == q);
}

TEMPLATE_TEST_CASE("propagate does not jump in its parameters", "", float, double) {
    using T = TestType;
    const T e = std::sqrt(std::numeric_limits<T>::epsilon()) / 100;
    for (const Case& c : cases()) {
        if (std::abs(c.lambda) > 100) continue;
        CAPTURE(c.b, c.lambda);
        const T b = T(c.b), l = T(c.lambda), step = e * std::max(T(1), std::abs(l));
        const Propagator<T> here = propagate(b, l, T(1)), beside = propagate(b + e, l + step, T(1));
        // Each of the functions changes with b and lambda h^2 by no more than about itself (E, B) or 1 + itself (C).
        const T size = std::max({T(1), std::abs(here.C), here.E});
        const T tolerance = (step + e) * size * 2 + 30 * std::numeric_limits<T>::epsilon() * size * (1 + std::abs(l));
        CHECK(std::abs(here.B - beside.B) <= tolerance);
        CHECK(std::abs(here.C - beside.C) <= tolerance);
        CHECK(std::abs(here.E - beside.E) <= tolerance);
    }
}

TEST_CASE("float is right to 1e-5") {
    const float h = 1.0f / 30;
    for (const Case& c : cases()) {
        CAPTURE(c.b, c.lambda);
        const float b = float(c.b) / h, lambda = float(c.lambda) / (h * h);
        const Propagator<float> p = propagate(b, lambda, h);
        const Wide B = impulse_response(b, lambda, h), C = rate_response(b, lambda, h), E = step_response(b, lambda, h);
        // A phase of x radians is known to x rounding errors only; growth by e^x likewise.
        const Wide blur = 1e-5L * std::max(Wide(1), std::sqrt(std::abs(Wide(c.lambda))) / 10);
        CHECK(std::abs(p.B - B) <= blur * std::max(std::abs(B), Wide(h) / std::sqrt(1 + std::abs(Wide(c.lambda)))));
        CHECK(std::abs(p.C - C) <= blur * std::max(std::abs(C), Wide(1)));
        CHECK(std::abs(p.E - E) <= blur * std::abs(E));
    }
}

TEMPLATE_TEST_CASE("huge stiffness and damping stay finite and bounded", "", float, double) {
    using T = TestType;
    const T top = largest_lambda<T>(), h = T(1) / 30;
    for (T lambda : {T(0), T(1), T(1e10), top})
        for (T b : {T(0), T(1), T(1e10), std::sqrt(top), top}) {
            CAPTURE(lambda, b);
            const Propagator<T> p = propagate(b, lambda, h);
            CHECK(std::isfinite(p.B));
            CHECK(std::isfinite(p.C));
            CHECK(std::isfinite(p.E));
            CHECK(std::abs(p.C) <= T(1.0001));
            CHECK(std::abs(p.B) <= T(1.0001) * h);
            CHECK(p.E >= 0);
            CHECK(p.E <= T(0.50001) * h * h);
        }
}
