// wide_turn.h: a joint's turn theta, for registers of lanes (wide_pair.h): exp(theta) = 1 + s theta* + c1 theta*^2,
// J = 1 - c1 theta* + c2 theta*^2, T = J^-1 = 1 + theta*/2 + t2 theta*^2 (math.h; J, T of the body's rates).
//
// This is the third of its kind. rotation_maps.h takes one sine and cosine and branches by |theta|; wide_maps.h gives the coupled step's maps in its
// two axes. The analytic step has no sine to spare, and asks for J's derivative. With q = |theta|^2 all are power series: few terms up to one radian,
// more up to 3.5, for the lanes that ask for them.
#pragma once
#include "../lanes/wide_maps.h"
#include "../lanes/wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class T> struct TurnSeries {
    static constexpr int few = sizeof(T) == 4 ? 5 : 9, many = sizeof(T) == 4 ? 9 : 15, few_t2 = sizeof(T) == 4 ? 6 : 11;
    static constexpr auto c1 = coefficients<T, many>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k + 2); });
    static constexpr auto c2 = coefficients<T, many>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k + 3); });
    // (s - 2 c1) / q = -2 t2 c1
    static constexpr auto dc1 =
        coefficients<T, many>([](int k) { return (k % 2 ? 2 : -2) * (k + 1) / factorial(2 * k + 4); });
    static constexpr auto t2 = coefficients<T, few_t2>([](int k) { // |B_2n| / (2n)!, Bernoulli's numbers, n = k + 1
        constexpr double c[] = {1. / 12,
                                1. / 720,
                                1. / 30240,
                                1. / 1209600,
                                1. / 47900160,
                                691. / 1307674368000,
                                1. / 74724249600,
                                3617. / 10670622842880000,
                                43867. / 5109094217170944000,
                                174611. / 802857662698291200000.,
                                77683. / 14101100039391805440000.};
        return c[k];
    });
};

template <class X> struct Turn { X s, c1, c2; };
template <class X> BOUGH_FORCE Turn<X> turn_of(const X& q) {
    using S = TurnSeries<RealOf<X>>;
    X c1 = series<S::few>(S::c1, q), c2 = series<S::few>(S::c2, q);
    const X one = each<X>(1);
    if (any_above(q, one)) {
        c1 = choose_above(q, one, series<S::many>(S::c1, q), c1);
        c2 = choose_above(q, one, series<S::many>(S::c2, q), c2);
    }
    return {1 - q * c2, c1, c2};
}
template <class X> BOUGH_FORCE X t2_of(const X& q) {
    using S = TurnSeries<RealOf<X>>;
    const X t2 = series<S::few_t2>(S::t2, q), one = each<X>(1);
    if (!any_above(q, one)) return t2;
    return choose_above(q, one, series<S::many>(S::dc1, q) / (-2 * series<S::many>(S::c1, q)), t2);
}

// 1 + a theta* + b theta*^2. (It is not shared with rotation_form of wide_maps.h: compilers for different targets fuse other products of that.)
template <class X> BOUGH_FORCE M3<X> turn_form(const V3<X>& t, const X& q, const X& a, const X& b) {
    const X d = 1 - b * q;
    const V3<X> s = a * t, bt = b * t;
    const X xy = bt.x * t.y, xz = bt.x * t.z, yz = bt.y * t.z;
    return {{d + bt.x * t.x, xy + s.z, xz - s.y},
            {xy - s.z, d + bt.y * t.y, yz + s.x},
            {xz + s.y, yz - s.x, d + bt.z * t.z}};
}

// T v, with v the body's rate. t2: of theta.
template <class X> BOUGH_FORCE V3<X> rate_of(const V3<X>& theta, const X& t2, const V3<X>& v) {
    const V3<X> across = cross(theta, v);
    return v + RealOf<X>(0.5) * across + t2 * cross(theta, across);
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
