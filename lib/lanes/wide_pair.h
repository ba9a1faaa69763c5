// wide_pair.h: two registers worked on as one number, so that a kernel whose every operation waits for the one before it has two to choose from. It
// also has what such kernels need beyond arithmetic, for one register and for two.
#pragma once
#include "wide_algebra.h"
#include <cstdint>
#include <limits>
#include <type_traits>

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class W> struct Pair { W a, b; };
template <class W> using LaneOf = std::remove_cvref_t<decltype(W{}[0])>;

#define BOUGH_PAIR_OPERATOR(op)                                                                                        \
    template <class W> BOUGH_FORCE Pair<W> operator op(const Pair<W>& x, const Pair<W>& y) {                           \
        return {x.a op y.a, x.b op y.b};                                                                               \
    }                                                                                                                  \
    template <class W, class S>                                                                                        \
    requires std::is_arithmetic_v<S> BOUGH_FORCE Pair<W>                                                               \
    operator op(const Pair<W>& x, S y) {                                                                               \
        return {x.a op LaneOf<W>(y), x.b op LaneOf<W>(y)};                                                             \
    }                                                                                                                  \
    template <class W, class S>                                                                                        \
    requires std::is_arithmetic_v<S> BOUGH_FORCE Pair<W>                                                               \
    operator op(S x, const Pair<W>& y) {                                                                               \
        return {LaneOf<W>(x) op y.a, LaneOf<W>(x) op y.b};                                                             \
    }
BOUGH_PAIR_OPERATOR(+)
BOUGH_PAIR_OPERATOR(-)
BOUGH_PAIR_OPERATOR(*)
BOUGH_PAIR_OPERATOR(/)
#undef BOUGH_PAIR_OPERATOR
template <class W> BOUGH_FORCE Pair<W> operator-(const Pair<W>& x) {
    return {-x.a, -x.b};
}

// For a register or a pair: its real, and its registers.
template <class X> struct Registers {
    using Real = LaneOf<X>;
    static constexpr int count = 1;
    static X& part(X& x, int) { return x; }
    static const X& part(const X& x, int) { return x; }
};
template <class W> struct Registers<Pair<W>> {
    using Real = typename Registers<W>::Real;
    static constexpr int count = 2;
    static W& part(Pair<W>& x, int k) { return k ? x.b : x.a; }
    static const W& part(const Pair<W>& x, int k) { return k ? x.b : x.a; }
};
template <class X> using RealOf = typename Registers<X>::Real;

// The same real in all lanes.
template <class X> BOUGH_FORCE X each(RealOf<X> value) {
    X x{};
    for (int k = 0; k < Registers<X>::count; ++k) Registers<X>::part(x, k) = all(value);
    return x;
}

template <class W> BOUGH_FORCE Pair<W> root(const Pair<W>& x) {
    return {root(x.a), root(x.b)};
}
template <class W> BOUGH_FORCE Pair<W> larger(const Pair<W>& x, const Pair<W>& y) {
    return {larger(x.a, y.a), larger(x.b, y.b)};
}
template <class W> BOUGH_FORCE bool any_above(const Pair<W>& x, const Pair<W>& y) {
    return any_above(x.a, y.a) || any_above(x.b, y.b);
}
// yes where a > b, else no.
template <class W> BOUGH_FORCE W choose_above(const W& a, const W& b, const W& yes, const W& no) {
    return a > b ? yes : no;
}
template <class W>
BOUGH_FORCE Pair<W> choose_above(const Pair<W>& a, const Pair<W>& b, const Pair<W>& yes, const Pair<W>& no) {
    return {choose_above(a.a, b.a, yes.a, no.a), choose_above(a.b, b.b, yes.b, no.b)};
}

// The integers as wide as a register's reals.
template <class T> struct Bits {
    using Integer = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    using Unsigned = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
#ifdef BOUGH_COUNTED
    using Wide = Integer;
    using WideUnsigned = Unsigned;
#else
    typedef Integer Wide __attribute__((vector_size(BOUGH_WIDTH)));
    typedef Unsigned WideUnsigned __attribute__((vector_size(BOUGH_WIDTH)));
#endif
    static constexpr int mantissa = sizeof(T) == 4 ? 23 : 52, bias = sizeof(T) == 4 ? 127 : 1023;
    // Added to a number below half of it, leaves the nearest integer, also in the low bits.
    static constexpr T rounder = sizeof(T) == 4 ? T(12582912) : T(6755399441055744);
};

// table[index], each lane its own; 0 <= index < 2^22.
BOUGH_FORCE WideFloat look_up(const float* table, const Bits<float>::Wide& index) {
#if defined(BOUGH_COUNTED)
    return table[index];
#elif defined(__AVX512F__)
    return WideFloat(_mm512_mask_i32gather_ps(__m512(WideFloat{}), 0xffff, __m512i(index), table, 4));
#elif defined(__AVX2__)
    return WideFloat(_mm256_i32gather_ps(table, __m256i(index), 4));
#else
    return WideFloat{table[index[0]], table[index[1]], table[index[2]], table[index[3]]};
#endif
}
BOUGH_FORCE WideDouble look_up(const double* table, const Bits<double>::Wide& index) {
#if defined(BOUGH_COUNTED)
    return table[index];
#elif defined(__AVX512F__)
    return WideDouble(_mm512_mask_i64gather_pd(__m512d(WideDouble{}), 0xff, __m512i(index), table, 8));
#elif defined(__AVX2__)
    return WideDouble(_mm256_i64gather_pd(table, __m256i(index), 8));
#else
    return WideDouble{table[index[0]], table[index[1]]};
#endif
}

template <class W> BOUGH_FORCE W magnitude(const W& x) {
    using B = Bits<RealOf<W>>;
    return W(typename B::WideUnsigned(x) & (typename B::Unsigned(-1) >> 1));
}
template <class W> BOUGH_FORCE Pair<W> magnitude(const Pair<W>& x) {
    return {magnitude(x.a), magnitude(x.b)};
}
// x with its sign turned where s is negative.
template <class W> BOUGH_FORCE W with_sign_of(const W& x, const W& s) {
    using B = Bits<RealOf<W>>;
    using I = typename B::WideUnsigned;
    const I sign = I{} + (typename B::Unsigned(1) << (8 * sizeof(RealOf<W>) - 1));
    return W(I(x) ^ (I(s) & sign));
}
template <class W> BOUGH_FORCE Pair<W> with_sign_of(const Pair<W>& x, const Pair<W>& s) {
    return {with_sign_of(x.a, s.a), with_sign_of(x.b, s.b)};
}

// A power series' coefficients, and its sum.
constexpr double factorial(int n) {
    return n < 2 ? 1 : n * factorial(n - 1);
}
template <class T, int n> struct Coefficients { T of[n]; };
template <class T, int n, class Term> constexpr Coefficients<T, n> coefficients(Term&& term) {
    Coefficients<T, n> c{};
    for (int k = 0; k < n; ++k) c.of[k] = T(term(k));
    return c;
}
template <int terms, class X, int n>
BOUGH_FORCE X series(const Coefficients<RealOf<X>, n>& c, const X& x) { // its first terms
    X sum = each<X>(c.of[terms - 1]);
    for (int k = terms - 2; k >= 0; --k) sum = sum * x + c.of[k];
    return sum;
}

// The power of two at or below |x|, and one over it. It is at most the largest power whose inverse is a normal number.
template <class X> struct Scale { X power, inverse; };
template <class W> BOUGH_FORCE Scale<W> scale_of(const W& x) {
    using B = Bits<RealOf<W>>;
    using I = typename B::WideUnsigned;
    constexpr auto exponents = typename B::Unsigned(2 * B::bias + 1) << B::mantissa;
    const I found = I(x) & exponents, most = I{} + (typename B::Unsigned(2 * B::bias - 1) << B::mantissa);
    const I bits = found > most ? most : found;
    return {W(bits), W((typename B::Unsigned(2 * B::bias) << B::mantissa) - bits)};
}
template <class W> BOUGH_FORCE Scale<Pair<W>> scale_of(const Pair<W>& x) {
    const Scale<W> a = scale_of(x.a), b = scale_of(x.b);
    return {{a.power, b.power}, {a.inverse, b.inverse}};
}

// 1 / sqrt(x), x > 0 and normal, to a rounding or two. It takes a first guess from the exponent's half and two or three iterations of third order,
// since a machine's own guess would differ on another machine. It is finite for x = 0.
template <class W> BOUGH_FORCE W inverse_root(const W& x) {
    using T = RealOf<W>;
    using I = typename Bits<T>::WideUnsigned;
    constexpr auto guess = typename Bits<T>::Unsigned(sizeof(T) == 4 ? 0x5f375a86u : 0x5fe6eb50c7b537a9u);
    W y = W(guess - (I(x) >> 1));
    for (int k = 0; k < (sizeof(T) == 4 ? 2 : 3); ++k) {
        const W e = 1 - x * y * y;
        y = y + y * e * (T(0.375) * e + T(0.5));
    }
    return y;
}
template <class W> BOUGH_FORCE Pair<W> inverse_root(const Pair<W>& x) {
    return {inverse_root(x.a), inverse_root(x.b)};
}

// A power series in each of n numbers, term by term in all of them.
template <int terms, class X, int n, int count>
BOUGH_FORCE void series(const Coefficients<RealOf<X>, count>& c, const X (&x)[n], X (&sum)[n]) {
    for (int i = 0; i < n; ++i) sum[i] = each<X>(c.of[terms - 1]);
    for (int k = terms - 2; k >= 0; --k)
        for (int i = 0; i < n; ++i) sum[i] = sum[i] * x[i] + c.of[k];
}

// e^x of each. Far below it stays the smallest number there is; far above (88 in float, 709 in double) it is infinite.
template <class W, int n> BOUGH_FORCE void exponentials(const W (&x)[n], W (&e)[n]) {
    using T = RealOf<W>;
    using B = Bits<T>;
    constexpr int terms = sizeof(T) == 4 ? 8 : 14;
    constexpr T least = sizeof(T) == 4 ? T(-87) : T(-708), most = sizeof(T) == 4 ? T(88.7) : T(709.7);
    W rounded[n], r[n];
    for (int i = 0; i < n; ++i) {
        const W inside = smaller(larger(x[i], all(least)), all(most));
        rounded[i] = inside * T(1.4426950408889634) + B::rounder;
        const W m = rounded[i] - B::rounder;
        // ln 2 in two parts, the first short enough for m times it to be exact.
        r[i] = (inside - m * T(0.693145751953125)) - m * T(1.42860682030941723e-6);
    }
    static constexpr auto taylor = coefficients<T, terms>([](int k) { return 1 / factorial(k); });
    series<terms>(taylor, r, e);
    for (int i = 0; i < n; ++i) e[i] = e[i] * W((typename B::Wide(rounded[i]) + B::bias) << B::mantissa);
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
