// wide_oscillator.h: one step of damped oscillators in closed form (base/oscillator.h), for registers of lanes.
//
// It is written a second time because a register has lanes of every case. So sine, cosine and exponentials are series that all lanes go through,
// several oscillators at once, while one number takes its case and the C library's functions. tests/lib/analytic/wide_spring.cpp holds the two
// together.
#pragma once
#include "../lanes/wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class W> struct WidePropagator { W B, C, E; };

// Steps n oscillators side by side. Each waits long for its own roots and series, and meanwhile the others go on. In units of the step: y = b h / 2,
// x = lambda h^2, z = x - y^2. Up to z = -(pi/4)^2 sine and cosine of sqrt z are their power series in z, on both sides of critical damping. Below,
// they are both roots' exponentials. Where |x| < 0.2 there, E is its own series in x and y.
template <class W, int n>
BOUGH_FORCE void propagate(const W (&b)[n], const W (&lambda)[n], RealOf<W> h, WidePropagator<W> (&p)[n]) {
    using T = RealOf<W>;
    using B = Bits<T>;
    constexpr int terms = sizeof(T) == 4 ? 6 : 10;            // of the cosine; of the sine one less
    constexpr T edge = T(0.6168502750680849);                 // (pi/4)^2
    constexpr T most = sizeof(T) == 4 ? T(1 << 21) : T(1e15); // where no digit of the phase is left
    W y[n], x[n], z[n], m[n], inverse_m[n], rounded[n], r[n], square[n], P[n], Q[n];
    for (int i = 0; i < n; ++i) {
        y[i] = (h / 2) * b[i];
        x[i] = (h * h) * lambda[i];
        z[i] = x[i] - y[i] * y[i];
        m[i] = root(magnitude(z[i]));
    }
    // sqrt z = k pi/2 + r
    for (int i = 0; i < n; ++i) {
        inverse_m[i] = 1 / m[i];
        const W angle = z[i] > 0 ? smaller(m[i], all(most)) : W{};
        rounded[i] = angle * T(0.6366197723675814) + B::rounder;
        const W k = rounded[i] - B::rounder;
        r[i] = ((angle - k * T(1.5703125)) - k * T(4.837512969970703125e-4)) - k * T(7.54978995489188216e-8);
        square[i] = k == 0 ? z[i] : r[i] * r[i];
    }
    static constexpr auto sines =
        coefficients<T, terms - 1>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k + 1); });
    static constexpr auto cosines = coefficients<T, terms>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k); });
    series<terms - 1>(sines, square, P);
    series<terms>(cosines, square, Q);
    W S[n], c[n], slow[n], sum[n], inverse_sum[n], decay[n]; // slow: what decays the slowest
    bool any_far = false;
    for (int i = 0; i < n; ++i) {
        const W rP = r[i] * P[i];
        const auto quadrant = typename B::Wide(rounded[i]);
        const auto odd = (quadrant & 1) != 0;
        const W sine = odd ? Q[i] : rP, cosine = odd ? rP : Q[i];
        S[i] = rounded[i] == B::rounder ? P[i] : ((quadrant & 2) != 0 ? -sine : sine) * inverse_m[i];
        c[i] = ((quadrant + 1) & 2) != 0 ? -cosine : cosine;
        slow[i] = -y[i];
        any_far |= any_above(all(-edge), z[i]);
    }
    if (any_far) {
        W twice[n], fast[n];
        for (int i = 0; i < n; ++i) twice[i] = -2 * m[i];
        exponentials(twice, fast);
        for (int i = 0; i < n; ++i) {
            sum[i] = y[i] + m[i];
            inverse_sum[i] = 1 / sum[i];
            const auto far = z[i] < -edge;
            S[i] = far ? T(0.5) * inverse_m[i] * (1 - fast[i]) : S[i];
            slow[i] = far ? -x[i] * inverse_sum[i] : slow[i];
            c[i] = far ? fast[i] : c[i];
        }
    }
    exponentials(slow, decay);
    W inverse_x[n];
    for (int i = 0; i < n; ++i) {
        inverse_x[i] = 1 / x[i];
        p[i].B = decay[i] * S[i];
        p[i].C = decay[i] * c[i] + slow[i] * p[i].B;
        p[i].E = (1 - (p[i].C + 2 * y[i] * p[i].B)) * inverse_x[i];
    }
    if (any_far) {
        static constexpr auto growth = coefficients<T, 14>([](int k) { return 1 / factorial(k + 1); });
        W near_zero[n];
        series<sizeof(T) == 4 ? 8 : 14>(growth, slow, near_zero);
        for (int i = 0; i < n; ++i) {
            const W grown = magnitude(slow[i]) < T(0.35) ? near_zero[i] : (1 - decay[i]) * sum[i] * inverse_x[i];
            p[i].E = z[i] < -edge ? (grown - p[i].B) * inverse_sum[i] : p[i].E;
        }
    }
    for (int i = 0; i < n; ++i) {
        const W small = z[i] < -edge ? all(T(1)) : magnitude(x[i]);
        if (!any_above(all(T(0.2)), small)) continue;
        W a0, a1{}, a2 = all(T(0.5)), total = a2;
        const W y2 = 2 * y[i];
        for (int k = 1; k < (sizeof(T) == 4 ? 14 : 24); ++k) {
            a0 = a1;
            a1 = a2;
            a2 = (y2 * a1) * (-1 / T(k + 2)) + (x[i] * a0) * (-1 / T((k + 1) * (k + 2)));
            total = total + a2;
        }
        p[i].E = small < T(0.2) ? total : p[i].E;
    }
    for (int i = 0; i < n; ++i) {
        p[i].B = h * p[i].B;
        p[i].E = (h * h) * p[i].E;
    }
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
