// wide_rows.h: a part of a row, as wide as a register, read and written by quantity, and records gathered and scattered by transposing.
#pragma once
#include "sweep_rows.h"
#include "wide_algebra.h"
#include <type_traits>

namespace bough::fast {
inline namespace BOUGH_TARGET {

// Reads quantity by quantity. T may be const. streamed: written past the caches.
template <class T, bool streamed = false> struct Rows {
    T* at; // of the row's quantity 0, at the part's first lane
    using Real = std::remove_const_t<T>;
    using W = Wide<Real>;

    BOUGH_FORCE W real(int k) const { return read<Real>(at + k * lanes<Real>); }
    BOUGH_FORCE V3<W> vector(int k) const { return {real(k), real(k + 1), real(k + 2)}; }
    BOUGH_FORCE Symmetric<W> symmetric(int k) const {
        return {real(k), real(k + 1), real(k + 2), real(k + 3), real(k + 4), real(k + 5)};
    }
    BOUGH_FORCE M3<W> matrix(int k) const { return {vector(k), vector(k + 3), vector(k + 6)}; }
    BOUGH_FORCE Complex<W> number(int k) const { return {real(k), real(k + 1)}; }
    BOUGH_FORCE V3<Complex<W>> complex_vector(int k) const { return {number(k), number(k + 2), number(k + 4)}; }
    BOUGH_FORCE Symmetric<Complex<W>> complex_symmetric(int k) const {
        return {number(k), number(k + 2), number(k + 4), number(k + 6), number(k + 8), number(k + 10)};
    }

    BOUGH_FORCE void set(int k, const W& w) const {
        if constexpr (streamed)
            stream(at + k * lanes<Real>, w);
        else
            write<Real>(at + k * lanes<Real>, w);
    }
    BOUGH_FORCE void set(int k, const Complex<W>& c) const {
        set(k, c.re);
        set(k + 1, c.im);
    }
    template <class X> BOUGH_FORCE void set(int k, const V3<X>& v) const {
        constexpr int one = int(sizeof(X) / sizeof(W));
        set(k, v.x);
        set(k + one, v.y);
        set(k + 2 * one, v.z);
    }
    template <class X> BOUGH_FORCE void set(int k, const M3<X>& m) const {
        constexpr int column = int(3 * sizeof(X) / sizeof(W));
        set(k, m.x);
        set(k + column, m.y);
        set(k + 2 * column, m.z);
    }
    template <class X> BOUGH_FORCE void set(int k, const Symmetric<X>& s) const {
        constexpr int one = int(sizeof(X) / sizeof(W));
        const X parts[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
        for (int j = 0; j < 6; ++j) set(k + j * one, parts[j]);
    }
};

// Records of `count` quantities, one for each lane of a register. In memory they stand one behind the other, as in a row.
template <class T, int count> struct Records {
    static constexpr int left = count % width<T>;            // quantities that fill no register,
    static constexpr bool few = width<T> == 16 && left <= 8; // of float's 16 so few that they are taken by four
    static constexpr int parts = few ? count - left : (count + width<T> - 1) / width<T> * width<T>;
    static constexpr int quantities = few ? (count + 3) / 4 * 4 : parts; // that are gathered and scattered
    static constexpr std::size_t stride = record(count, lanes<T>);
    alignas(64) T row[(count + width<T> - 1) / width<T> * width<T> * lanes<T>];

    BOUGH_FORCE Rows<T> rows() { return {row}; }

    // Gathers the quantities of joints[l] into lane l.
    [[gnu::noinline]] void gather(const T* records, const std::uint32_t* joints) {
        for (int k = 0; k < parts; k += width<T>) {
            Wide<T> m[width<T>];
            for (int l = 0; l < width<T>; ++l) m[l] = read(records + joints[l] * stride + std::size_t(k));
            transpose(m);
            for (int j = 0; j < width<T>; ++j) write(row + (k + j) * lanes<T>, m[j]);
        }
#if BOUGH_WIDTH == 64 && !defined(BOUGH_COUNTED)
        if constexpr (few)
            for (int k = parts; k < quantities; k += 4) {
                const auto four = [&](int l) { return read_four(records + joints[l] * stride + std::size_t(k)); };
                Wide<T> m[4];
                for (int l = 0; l < 4; ++l) m[l] = side_by_side(four(l), four(l + 4), four(l + 8), four(l + 12));
                transpose_quarters(m);
                for (int j = 0; j < 4; ++j) write(row + (k + j) * lanes<T>, m[j]);
            }
#endif
    }
    // Scatters lane l into the record of joints[l], except for `skip`. It is added to what stands there, or replaces it.
    template <bool added> [[gnu::noinline]] void scatter(T* records, const std::uint32_t* joints, std::uint32_t skip) {
        for (int k = 0; k < parts; k += width<T>) {
            Wide<T> m[width<T>];
            for (int j = 0; j < width<T>; ++j) m[j] = read(row + (k + j) * lanes<T>);
            transpose(m);
            for (int l = 0; l < width<T>; ++l) {
                if (joints[l] == skip) continue;
                T* at = records + joints[l] * stride + std::size_t(k);
                write(at, added ? read(at) + m[l] : m[l]);
            }
        }
#if BOUGH_WIDTH == 64 && !defined(BOUGH_COUNTED)
        if constexpr (few)
            for (int k = parts; k < quantities; k += 4) {
                Wide<T> m[4];
                for (int j = 0; j < 4; ++j) m[j] = read(row + (k + j) * lanes<T>);
                transpose_quarters(m);
                for (int l = 0; l < width<T>; ++l) {
                    if (joints[l] == skip) continue;
                    T* at = records + joints[l] * stride + std::size_t(k);
                    const FourFloats four = quarter(m[l % 4], l / 4);
                    write_four(at, added ? read_four(at) + four : four);
                }
            }
#endif
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
