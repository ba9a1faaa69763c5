// wide_maps.h: rotation_maps.h for registers of lanes: exp(theta), J, J^-1 and J_dot eta, without branches.
//
// With q = |theta|^2 all is made of four entire functions, by their series:
//   c1 = sum (-q)^k / (2k+2)!,   c2 = sum (-q)^k / (2k+3)!,   s = 1 - q c2
//   c1' = (s - 2 c1) / q = -sum 2k (-q)^(k-1) / (2k+2)!  over k >= 1,   c2' = (c1 - 3 c2) / q = -sum 2k (-q)^(k-1) / (2k+3)!
//   t2 = (1 - s / (2 c1)) / q = -c1' / (2 c1)
// to rounding up to |theta| = 3.5: half a turn and half a step on.
// It is written a second time because without branches there is no quotient of sines for large angles. So the series are longer, and end at 3.5.
#pragma once
#include "wide_algebra.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// 1 + a theta* + b theta* theta*, with theta* theta* = theta theta^T - q.
template <class W> BOUGH_FORCE M3<W> rotation_form(const V3<W>& t, W q, W a, W b) {
    const W d = 1 - b * q;
    const W xy = b * t.x * t.y, xz = b * t.x * t.z, yz = b * t.y * t.z;
    const V3<W> s = a * t;
    return {{d + b * t.x * t.x, xy + s.z, xz - s.y},
            {xy - s.z, d + b * t.y * t.y, yz + s.x},
            {xz + s.y, yz - s.x, d + b * t.z * t.z}};
}

template <class T> struct WideMaps {
    using W = Wide<T>;
    V3<W> theta;
    W q, c1, c2, dc1, dc2;

    BOUGH_FORCE M3<W> R() const { return rotation_form(theta, q, W(1 - q * c2), c1); }
    BOUGH_FORCE M3<W> J() const { return rotation_form(theta, q, c1, c2); }
    BOUGH_FORCE M3<W> J_inverse() const { return rotation_form(theta, q, all<T>(T(-0.5)), W(dc1 / (-2 * c1))); }

    BOUGH_FORCE V3<W> rate_bias(const V3<W>& eta) const {
        const V3<W> across = cross(theta, eta);
        return dot(theta, eta) * (dc1 * across + dc2 * cross(theta, across)) + c2 * cross(eta, across);
    }
};

template <class T> BOUGH_FORCE WideMaps<T> wide_maps(const V3<Wide<T>>& theta) {
    using W = Wide<T>;
    constexpr int few = sizeof(T) == 4 ? 6 : 10, terms = sizeof(T) == 4 ? 9 : 15; // up to one radian, and beyond
    struct Series {
        T c1[terms], c2[terms], dc1[terms], dc2[terms];
        constexpr Series() : c1(), c2(), dc1(), dc2() {
            double factorial = 2, sign = 1; // (2k+2)!
            for (int k = 0; k < terms; ++k) {
                c1[k] = T(sign / factorial);
                c2[k] = T(sign / (factorial * (2 * k + 3)));
                factorial *= (2 * k + 3) * (2 * k + 4); // of k + 1
                sign = -sign;
                dc1[k] = T(sign * 2 * (k + 1) / factorial);
                dc2[k] = T(sign * 2 * (k + 1) / (factorial * (2 * k + 5)));
            }
        }
    };
    static constexpr Series series;
    const W q = dot(theta, theta);
    W c1, c2, dc1, dc2;
    const auto sum = [&](int count) {
        c1 = all<T>(series.c1[count - 1]), c2 = all<T>(series.c2[count - 1]);
        dc1 = all<T>(series.dc1[count - 1]), dc2 = all<T>(series.dc2[count - 1]);
#pragma GCC unroll 16
        for (int k = count - 2; k >= 0; --k) {
            c1 = c1 * q + series.c1[k];
            c2 = c2 * q + series.c2[k];
            dc1 = dc1 * q + series.dc1[k];
            dc2 = dc2 * q + series.dc2[k];
        }
    };
    if (any_above(q, all<T>(T(1)))) [[unlikely]]
        sum(terms);
    else
        sum(few);
    return {theta, q, c1, c2, dc1, dc2};
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
