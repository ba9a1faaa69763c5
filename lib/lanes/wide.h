// wide.h: the narrow layer between the kernels over lanes and a machine's SIMD registers: one vector of reals, as wide as the target for which this
// file is compiled (target.h), by the compilers' vector extension (GCC, clang: x86, NEON, WebAssembly).
//
// Why this and not a library. The kernels need arithmetic, a square root, a comparison and a transpose, no more. A row of lanes is 64 bytes in memory
// whatever the target (layout.h). It is worked on in 1, 2 or 4 parts of the register's width, so nothing of the partition depends on it. Everything
// here has the target in its name (inline namespace), so two targets' code never meets in the linker.
#pragma once
#include <cmath>
#include <cstring>
#ifdef BOUGH_COUNTED
#include "wide_counted.h" // in place of all that is about registers
#elif defined(__AVX2__)
#include <immintrin.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#if defined(__AVX512F__)
#define BOUGH_WIDTH 64
#elif defined(__AVX2__)
#define BOUGH_WIDTH 32
#else
#define BOUGH_WIDTH 16
#endif

namespace bough::fast {
inline namespace BOUGH_TARGET {

#ifndef BOUGH_COUNTED
typedef float WideFloat __attribute__((vector_size(BOUGH_WIDTH)));
typedef double WideDouble __attribute__((vector_size(BOUGH_WIDTH)));
#endif
template <class T> struct WideOf;
template <> struct WideOf<float> { using type = WideFloat; };
template <> struct WideOf<double> { using type = WideDouble; };
template <class T> using Wide = typename WideOf<T>::type;

#ifndef BOUGH_COUNTED
template <class T> constexpr int width = int(BOUGH_WIDTH / sizeof(T)); // reals in a register
#endif
template <class T> constexpr int lanes = int(64 / sizeof(T)); // reals in a row (layout.h)

template <class T> [[gnu::always_inline]] inline Wide<T> read(const T* at) {
    Wide<T> w;
    std::memcpy(&w, at, sizeof w);
    return w;
}
template <class T> [[gnu::always_inline]] inline void write(T* at, Wide<T> w) {
    std::memcpy(at, &w, sizeof w);
}
#ifndef BOUGH_COUNTED
// Writes past the caches what is not read again soon; `at` is aligned. It is for whole lines only. Where a register is a part of one, its other parts
// come much later, and memory would be written twice (measured with AVX2: half as fast as through the caches).
#if BOUGH_WIDTH == 64
[[gnu::always_inline]] inline void stream(float* at, WideFloat w) {
    _mm512_stream_ps(at, __m512(w));
}
[[gnu::always_inline]] inline void stream(double* at, WideDouble w) {
    _mm512_stream_pd(at, __m512d(w));
}
#else
[[gnu::always_inline]] inline void stream(float* at, WideFloat w) {
    write(at, w);
}
[[gnu::always_inline]] inline void stream(double* at, WideDouble w) {
    write(at, w);
}
#endif

template <class T> [[gnu::always_inline]] inline Wide<T> all(T value) {
    return Wide<T>{} + value;
}

#if defined(__AVX512F__)
[[gnu::always_inline]] inline WideFloat root(WideFloat w) {
    return WideFloat(_mm512_maskz_sqrt_ps(0xffff, __m512(w)));
}
[[gnu::always_inline]] inline WideDouble root(WideDouble w) {
    return WideDouble(_mm512_maskz_sqrt_pd(0xff, __m512d(w)));
}
[[gnu::always_inline]] inline bool any_above(WideFloat a, WideFloat b) {
    return _mm512_cmp_ps_mask(__m512(a), __m512(b), _CMP_GT_OQ) != 0;
}
[[gnu::always_inline]] inline bool any_above(WideDouble a, WideDouble b) {
    return _mm512_cmp_pd_mask(__m512d(a), __m512d(b), _CMP_GT_OQ) != 0;
}
#elif defined(__AVX2__)
[[gnu::always_inline]] inline WideFloat root(WideFloat w) {
    return WideFloat(_mm256_sqrt_ps(__m256(w)));
}
[[gnu::always_inline]] inline WideDouble root(WideDouble w) {
    return WideDouble(_mm256_sqrt_pd(__m256d(w)));
}
[[gnu::always_inline]] inline bool any_above(WideFloat a, WideFloat b) {
    return _mm256_movemask_ps(_mm256_cmp_ps(__m256(a), __m256(b), _CMP_GT_OQ)) != 0;
}
[[gnu::always_inline]] inline bool any_above(WideDouble a, WideDouble b) {
    return _mm256_movemask_pd(_mm256_cmp_pd(__m256d(a), __m256d(b), _CMP_GT_OQ)) != 0;
}
#elif defined(__wasm_simd128__) // whose compiler does not make one instruction of the loops below
[[gnu::always_inline]] inline WideFloat root(WideFloat w) {
    return WideFloat(wasm_f32x4_sqrt(v128_t(w)));
}
[[gnu::always_inline]] inline WideDouble root(WideDouble w) {
    return WideDouble(wasm_f64x2_sqrt(v128_t(w)));
}
[[gnu::always_inline]] inline bool any_above(WideFloat a, WideFloat b) {
    return wasm_v128_any_true(wasm_f32x4_gt(v128_t(a), v128_t(b)));
}
[[gnu::always_inline]] inline bool any_above(WideDouble a, WideDouble b) {
    return wasm_v128_any_true(wasm_f64x2_gt(v128_t(a), v128_t(b)));
}
#else
template <class W> [[gnu::always_inline]] inline W root(W w) {
    for (unsigned k = 0; k < sizeof(W) / sizeof(w[0]); ++k) w[k] = std::sqrt(w[k]);
    return w;
}
template <class W> [[gnu::always_inline]] inline bool any_above(W a, W b) {
    bool any = false;
    for (unsigned k = 0; k < sizeof(W) / sizeof(a[0]); ++k) any |= a[k] > b[k];
    return any;
}
#endif
#endif // BOUGH_COUNTED

// While it lives, results too small for a normal number are 0. What comes to rest would otherwise pass through numbers on which every operation takes
// a hundred times as long.
class FlushToZero {
public:
#ifdef __x86_64__
    FlushToZero() : before_(__builtin_ia32_stmxcsr()) {
        __builtin_ia32_ldmxcsr(before_ | 0x8040u);
    }
    ~FlushToZero() {
        __builtin_ia32_ldmxcsr(before_);
    }

private:
    unsigned before_;
#else
    FlushToZero() {}
#endif
public:
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;
};

#ifndef BOUGH_COUNTED
// Returns value where a > b, else 0.
template <class W> [[gnu::always_inline]] inline W where_above(W a, W b, W value) {
    return a > b ? value : W{};
}
template <class W> [[gnu::always_inline]] inline auto total(W w) { // NaN if any is
    auto sum = w[0];
    for (unsigned k = 1; k < sizeof(W) / sizeof(w[0]); ++k) sum += w[k];
    return sum;
}
template <class W> [[gnu::always_inline]] inline W smaller(W a, W b) {
    return a < b ? a : b;
}
template <class W> [[gnu::always_inline]] inline W larger(W a, W b) {
    return a > b ? a : b;
}

// Transposes a square m in place: m[i][k] <-> m[k][i]. It takes log2(width) rounds of width two-input shuffles.
[[gnu::always_inline]] inline void transpose(WideDouble (&m)[width<double>]) {
#if BOUGH_WIDTH == 64
    WideDouble t[8], u[8];
    for (int i = 0; i < 8; i += 2) {
        t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 8; i += 4)
        for (int k = 0; k < 2; ++k) {
            u[i + k] = __builtin_shufflevector(t[i + k], t[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            u[i + k + 2] = __builtin_shufflevector(t[i + k], t[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < 4; ++k) {
        m[k] = __builtin_shufflevector(u[k], u[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        m[k + 4] = __builtin_shufflevector(u[k], u[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
#elif BOUGH_WIDTH == 32
    WideDouble t[4];
    for (int i = 0; i < 4; i += 2) {
        t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 4, 2, 6);
        t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 5, 3, 7);
    }
    for (int k = 0; k < 2; ++k) {
        m[k] = __builtin_shufflevector(t[k], t[k + 2], 0, 1, 4, 5);
        m[k + 2] = __builtin_shufflevector(t[k], t[k + 2], 2, 3, 6, 7);
    }
#else
    const WideDouble low = __builtin_shufflevector(m[0], m[1], 0, 2);
    m[1] = __builtin_shufflevector(m[0], m[1], 1, 3);
    m[0] = low;
#endif
}
[[gnu::always_inline]] inline void transpose(WideFloat (&m)[width<float>]) {
#if BOUGH_WIDTH == 64
    WideFloat t[16], u[16];
    for (int i = 0; i < 16; i += 2) {
        t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 16, 2, 18, 4, 20, 6, 22, 8, 24, 10, 26, 12, 28, 14, 30);
        t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 17, 3, 19, 5, 21, 7, 23, 9, 25, 11, 27, 13, 29, 15, 31);
    }
    for (int i = 0; i < 16; i += 4)
        for (int k = i; k < i + 2; ++k) {
            u[k] = __builtin_shufflevector(t[k], t[k + 2], 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
            u[k + 2] =
                __builtin_shufflevector(t[k], t[k + 2], 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
        }
    for (int i = 0; i < 16; i += 8)
        for (int k = i; k < i + 4; ++k) {
            t[k] = __builtin_shufflevector(u[k], u[k + 4], 0, 1, 2, 3, 16, 17, 18, 19, 8, 9, 10, 11, 24, 25, 26, 27);
            t[k + 4] =
                __builtin_shufflevector(u[k], u[k + 4], 4, 5, 6, 7, 20, 21, 22, 23, 12, 13, 14, 15, 28, 29, 30, 31);
        }
    for (int k = 0; k < 8; ++k) {
        m[k] = __builtin_shufflevector(t[k], t[k + 8], 0, 1, 2, 3, 4, 5, 6, 7, 16, 17, 18, 19, 20, 21, 22, 23);
        m[k + 8] =
            __builtin_shufflevector(t[k], t[k + 8], 8, 9, 10, 11, 12, 13, 14, 15, 24, 25, 26, 27, 28, 29, 30, 31);
    }
#elif BOUGH_WIDTH == 32
    WideFloat t[8], u[8];
    for (int i = 0; i < 8; i += 2) {
        t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 8; i += 4)
        for (int k = i; k < i + 2; ++k) {
            u[k] = __builtin_shufflevector(t[k], t[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            u[k + 2] = __builtin_shufflevector(t[k], t[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < 4; ++k) {
        m[k] = __builtin_shufflevector(u[k], u[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        m[k + 4] = __builtin_shufflevector(u[k], u[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
#else
    WideFloat t[4];
    for (int i = 0; i < 4; i += 2) {
        t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 4, 2, 6);
        t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 5, 3, 7);
    }
    for (int k = 0; k < 2; ++k) {
        m[k] = __builtin_shufflevector(t[k], t[k + 2], 0, 1, 4, 5);
        m[k + 2] = __builtin_shufflevector(t[k], t[k + 2], 2, 3, 6, 7);
    }
#endif
}

#if BOUGH_WIDTH == 64
typedef float FourFloats __attribute__((vector_size(16)));
[[gnu::always_inline]] inline FourFloats read_four(const float* at) {
    FourFloats four;
    std::memcpy(&four, at, sizeof four);
    return four;
}
[[gnu::always_inline]] inline void write_four(float* at, FourFloats four) {
    std::memcpy(at, &four, sizeof four);
}
[[gnu::always_inline]] inline WideFloat side_by_side(FourFloats a, FourFloats b, FourFloats c, FourFloats d) {
    return __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7),
                                   __builtin_shufflevector(c, d, 0, 1, 2, 3, 4, 5, 6, 7), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,
                                   10, 11, 12, 13, 14, 15);
}
[[gnu::always_inline]] inline FourFloats quarter(WideFloat w, int q) {
    FourFloats four;
    std::memcpy(&four, reinterpret_cast<const char*>(&w) + 16 * q, sizeof four);
    return four;
}
// Transposes four numbers of each of 16 records, in place, in either direction: between those of record 4 q + k in the quarter q of m[k], and the
// k-th of all records in m[k].
[[gnu::always_inline]] inline void transpose_quarters(WideFloat (&m)[4]) {
    WideFloat t[4];
    for (int i = 0; i < 4; i += 2) {
        t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 16, 2, 18, 4, 20, 6, 22, 8, 24, 10, 26, 12, 28, 14, 30);
        t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 17, 3, 19, 5, 21, 7, 23, 9, 25, 11, 27, 13, 29, 15, 31);
    }
    for (int k = 0; k < 2; ++k) {
        m[k] = __builtin_shufflevector(t[k], t[k + 2], 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
        m[k + 2] = __builtin_shufflevector(t[k], t[k + 2], 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
    }
}
#endif
#endif // BOUGH_COUNTED

} // namespace BOUGH_TARGET
} // namespace bough::fast
