// wide_algebra.h: 3-vectors and 3x3 matrices whose elements are registers of lanes (wide.h), real or complex. A complex element is two real
// registers. A product of a real and a complex one costs half.
#pragma once
#include "wide.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

#ifdef BOUGH_COUNTED // it runs for a moment, and forced inlining is most of what compiling it takes
#define BOUGH_FORCE inline
#else
#define BOUGH_FORCE [[gnu::always_inline]] inline
#endif

template <class W> struct Complex { W re, im; };
template <class W> BOUGH_FORCE Complex<W> operator+(const Complex<W>& a, const Complex<W>& b) {
    return {a.re + b.re, a.im + b.im};
}
template <class W> BOUGH_FORCE Complex<W> operator-(const Complex<W>& a, const Complex<W>& b) {
    return {a.re - b.re, a.im - b.im};
}
template <class W> BOUGH_FORCE Complex<W> operator-(const Complex<W>& a) {
    return {-a.re, -a.im};
}
template <class W> BOUGH_FORCE Complex<W> operator+(const Complex<W>& a, const W& b) {
    return {a.re + b, a.im};
}
template <class W> BOUGH_FORCE Complex<W> operator-(const Complex<W>& a, const W& b) {
    return {a.re - b, a.im};
}
template <class W> BOUGH_FORCE Complex<W> operator*(const Complex<W>& a, const Complex<W>& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
template <class W> BOUGH_FORCE Complex<W> operator*(const W& a, const Complex<W>& b) {
    return {a * b.re, a * b.im};
}
template <class W> BOUGH_FORCE Complex<W> operator*(const Complex<W>& a, const W& b) {
    return {a.re * b, a.im * b};
}
template <class W> BOUGH_FORCE Complex<W> inverse(const Complex<W>& a) {
    const W scale = 1 / (a.re * a.re + a.im * a.im);
    return {a.re * scale, -a.im * scale};
}

// sum + a b and sum - a b. They are written out so that each of their products can be fused with a sum; a complex product by itself fuses half.
template <class W> BOUGH_FORCE W plus(const W& sum, const W& a, const W& b) {
    return sum + a * b;
}
template <class W> BOUGH_FORCE W minus(const W& sum, const W& a, const W& b) {
    return sum - a * b;
}
template <class W> BOUGH_FORCE Complex<W> plus(const Complex<W>& sum, const Complex<W>& a, const Complex<W>& b) {
    return {sum.re + a.re * b.re - a.im * b.im, sum.im + a.re * b.im + a.im * b.re};
}
template <class W> BOUGH_FORCE Complex<W> minus(const Complex<W>& sum, const Complex<W>& a, const Complex<W>& b) {
    return {sum.re - a.re * b.re + a.im * b.im, sum.im - a.re * b.im - a.im * b.re};
}
template <class W> BOUGH_FORCE Complex<W> plus(const Complex<W>& sum, const W& a, const Complex<W>& b) {
    return {sum.re + a * b.re, sum.im + a * b.im};
}
template <class W> BOUGH_FORCE Complex<W> minus(const Complex<W>& sum, const W& a, const Complex<W>& b) {
    return {sum.re - a * b.re, sum.im - a * b.im};
}
template <class W> BOUGH_FORCE Complex<W> plus(const Complex<W>& sum, const Complex<W>& a, const W& b) {
    return plus(sum, b, a);
}

template <class X> struct V3 { X x, y, z; };
template <class X> BOUGH_FORCE V3<X> operator+(const V3<X>& a, const V3<X>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class X> BOUGH_FORCE V3<X> operator-(const V3<X>& a, const V3<X>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class X> BOUGH_FORCE V3<X> operator-(const V3<X>& a) {
    return {-a.x, -a.y, -a.z};
}
template <class S, class X> BOUGH_FORCE auto operator*(const S& s, const V3<X>& a) -> V3<decltype(s * a.x)> {
    return {s * a.x, s * a.y, s * a.z};
}
template <class X, class Y> BOUGH_FORCE auto dot(const V3<X>& a, const V3<Y>& b) {
    return plus(plus(a.x * b.x, a.y, b.y), a.z, b.z);
}
// sum + a . b, sum - a . b
template <class S, class X, class Y> BOUGH_FORCE S plus_dot(const S& sum, const V3<X>& a, const V3<Y>& b) {
    return plus(plus(plus(sum, a.x, b.x), a.y, b.y), a.z, b.z);
}
template <class S, class X, class Y> BOUGH_FORCE S minus_dot(const S& sum, const V3<X>& a, const V3<Y>& b) {
    return minus(minus(minus(sum, a.x, b.x), a.y, b.y), a.z, b.z);
}
template <class X, class Y> BOUGH_FORCE auto cross(const V3<X>& a, const V3<Y>& b) -> V3<decltype(a.x * b.x)> {
    return {minus(a.y * b.z, a.z, b.y), minus(a.z * b.x, a.x, b.z), minus(a.x * b.y, a.y, b.x)};
}
// sum + a x b
template <class X, class Y> BOUGH_FORCE auto plus_cross(const V3<Y>& sum, const V3<X>& a, const V3<Y>& b) {
    return V3<Y>{minus(plus(sum.x, a.y, b.z), a.z, b.y), minus(plus(sum.y, a.z, b.x), a.x, b.z),
                 minus(plus(sum.z, a.x, b.y), a.y, b.x)};
}
template <class S, class X>
BOUGH_FORCE V3<Complex<S>> plus(const V3<Complex<S>>& sum, const Complex<S>& s, const V3<X>& a) {
    return {plus(sum.x, s, a.x), plus(sum.y, s, a.y), plus(sum.z, s, a.z)};
}
template <class W> BOUGH_FORCE V3<Complex<W>> complex(const V3<W>& re, const V3<W>& im) {
    return {{re.x, im.x}, {re.y, im.y}, {re.z, im.z}};
}

// Stored by columns: a matrix times a vector is a sum of them.
template <class X> struct M3 { V3<X> x, y, z; };
template <class X, class Y> BOUGH_FORCE auto operator*(const M3<X>& m, const V3<Y>& v) -> V3<decltype(m.x.x * v.x)> {
    return {plus(plus(m.x.x * v.x, m.y.x, v.y), m.z.x, v.z), plus(plus(m.x.y * v.x, m.y.y, v.y), m.z.y, v.z),
            plus(plus(m.x.z * v.x, m.y.z, v.y), m.z.z, v.z)};
}
template <class X, class Y> BOUGH_FORCE auto operator*(const M3<X>& a, const M3<Y>& b) -> M3<decltype(a.x.x * b.x.x)> {
    return {a * b.x, a * b.y, a * b.z};
}
template <class X, class Y>
BOUGH_FORCE auto transposed_times(const M3<X>& m, const V3<Y>& v) -> V3<decltype(m.x.x * v.x)> {
    return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}
template <class X> BOUGH_FORCE M3<X> transposed(const M3<X>& m) {
    return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}};
}
template <class X> BOUGH_FORCE M3<X> operator+(const M3<X>& a, const M3<X>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class X> struct Symmetric { X xx, xy, xz, yy, yz, zz; };
template <class X> BOUGH_FORCE M3<X> full(const Symmetric<X>& s) {
    return {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
}
template <class X> BOUGH_FORCE Symmetric<X> operator+(const Symmetric<X>& a, const Symmetric<X>& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
template <class S, class X>
BOUGH_FORCE auto operator*(const S& s, const Symmetric<X>& a) -> Symmetric<decltype(s * a.xx)> {
    return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz};
}
template <class X, class Y>
BOUGH_FORCE auto operator*(const Symmetric<X>& s, const V3<Y>& v) -> V3<decltype(s.xx * v.x)> {
    return {plus(plus(s.xx * v.x, s.xy, v.y), s.xz, v.z), plus(plus(s.xy * v.x, s.yy, v.y), s.yz, v.z),
            plus(plus(s.xz * v.x, s.yz, v.y), s.zz, v.z)};
}
template <class X, class Y>
BOUGH_FORCE auto operator*(const Symmetric<X>& s, const M3<Y>& m) -> M3<decltype(s.xx * m.x.x)> {
    return {s * m.x, s * m.y, s * m.z};
}
// R s R^T.
template <class W> BOUGH_FORCE Symmetric<W> turned(const M3<W>& R, const Symmetric<W>& s) {
    const M3<W> q = transposed(R * full(s)); // rows of R s
    const M3<W> rows = transposed(R);
    return {dot(q.x, rows.x), dot(q.x, rows.y), dot(q.x, rows.z), dot(q.y, rows.y), dot(q.y, rows.z), dot(q.z, rows.z)};
}
// a^T b where that is symmetric.
template <class X> BOUGH_FORCE Symmetric<X> symmetric_transposed_product(const M3<X>& a, const M3<X>& b) {
    return {dot(a.x, b.x), dot(a.x, b.y), dot(a.x, b.z), dot(a.y, b.y), dot(a.y, b.z), dot(a.z, b.z)};
}
template <class X> BOUGH_FORCE Symmetric<X> operator-(const Symmetric<X>& a, const Symmetric<X>& b) {
    return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}

// [r]* m, column by column.
template <class W, class X> BOUGH_FORCE M3<X> cross_left(const V3<W>& r, const M3<X>& m) {
    return {cross(r, m.x), cross(r, m.y), cross(r, m.z)};
}
template <class X> BOUGH_FORCE Symmetric<X> upper(const M3<X>& m) {
    return {m.x.x, m.y.x, m.z.x, m.y.y, m.z.y, m.z.z};
}

template <class W>
BOUGH_FORCE Symmetric<Complex<W>> plus(const Symmetric<Complex<W>>& sum, const Complex<W>& s, const Symmetric<W>& a) {
    return {plus(sum.xx, s, a.xx), plus(sum.xy, s, a.xy), plus(sum.xz, s, a.xz),
            plus(sum.yy, s, a.yy), plus(sum.yz, s, a.yz), plus(sum.zz, s, a.zz)};
}

// The inverse of a complex symmetric matrix = L D L^T, L with unit diagonal. scale: about 1 over its elements. Without it, what a float's square
// loses would make 1/0 of the lightest leaves.
template <class W> BOUGH_FORCE Symmetric<Complex<W>> inverse(const Symmetric<Complex<W>>& s, const W& scale) {
    using X = Complex<W>;
    const auto over = [&](const X& a) {
        const X b = scale * a;
        const W one = scale / (b.re * b.re + b.im * b.im);
        return X{b.re * one, -b.im * one};
    };
    const X d0 = over(s.xx);
    const X l10 = s.xy * d0, l20 = s.xz * d0;
    const X d1 = over(minus(s.yy, l10, s.xy));
    const X y21 = minus(s.yz, l20, s.xy);
    const X l21 = y21 * d1;
    const X d2 = over(minus(minus(s.zz, l20, s.xz), l21, y21));
    const X m20 = minus(l20, l10, l21); // L^-1 has -l10, -l21 and -m20 below its diagonal
    Symmetric<X> e;
    e.zz = d2;
    e.yz = -(l21 * d2);
    e.xz = -(m20 * d2);
    e.yy = minus(d1, l21, e.yz);
    const X l10d1 = l10 * d1;
    e.xy = minus(-l10d1, l21, e.xz);
    e.xx = minus(plus(d0, l10, l10d1), m20, e.xz);
    return e;
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
