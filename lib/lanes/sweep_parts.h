// sweep_parts.h: what the sweeps of both steps over lanes share: constants, the wind (wide_wind.h) and the air (wide_air.h, wide_leaf.h).
#pragma once
#include "wide_air.h"
#include "wide_leaf.h"
#include "wide_maps.h"
#include "wide_wind.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// Asks for lines [from, to) of what the next row will read. Beyond the last line nothing happens. A row asks for them few at a time among its
// arithmetic: all at once fill the core's queue of misses, and what the row itself reads waits behind them. The barrier keeps the compiler from
// gathering them.
template <int from, int to, class T> BOUGH_FORCE void prefetch(const T* at) {
#pragma GCC unroll 64
    for (int k = from; k < to; ++k) __builtin_prefetch(at + k * lanes<T>);
    __asm__ volatile("");
}

// Makes the compiler read from memory again what stands there. Otherwise it would keep it on its stack.
BOUGH_FORCE void forget_memory() {
    __asm__ volatile("" ::: "memory");
}

// Given is what the sweeps of one step read and write: a SweepRows and more.
template <class T, class Given> struct SweepParts : WideWind<T, Given> {
    using Base = WideWind<T, Given>;
    using Base::Base;
    using Base::L;
    using Base::rows;
    using typename Base::W;
    using C = Complex<W>;
    // The square of an angle that may be past half a turn: a little below pi squared. The rest is checked body by body.
    static constexpr T about_half_turn2 = T(9.869);
    // Sums of squares of angles and rates above this are taken for non-finite numbers, or numbers that soon will be.
    static constexpr T still_finite2 = T(1e30);

    static C number(const T (&z)[2]) { return {all(z[0]), all(z[1])}; }
    static V3<W> vector(const T (&v)[3]) { return {all(v[0]), all(v[1]), all(v[2])}; }

    // Returns where the constants of a row stand (shared_constants.h). The row may be the one beyond the last, of which nothing is read.
    BOUGH_FORCE std::size_t constants_row(std::uint32_t row) const {
        return rows.constants_row ? rows.constants_row[row] : row;
    }

    // Returns how much clumps' leaves face up (Plan::facing); of other kinds, which do not read it, 0.
    template <Kind kind> BOUGH_FORCE W facing(std::uint32_t row, int lane) const {
        if constexpr (kind == Kind::clump)
            return read(rows.facing + row * std::size_t(L) + std::size_t(lane));
        else
            return W{};
    }

    // Returns the rotation to the parent's body frame from the joint frame.
    BOUGH_FORCE static M3<W> joint_rotation(const Rows<const T>& k) {
        const W w = k.real(body_constant::R_pj), x = k.real(body_constant::R_pj + 1),
                y = k.real(body_constant::R_pj + 2), z = k.real(body_constant::R_pj + 3);
        const W x2 = x + x, y2 = y + y, z2 = z + z;
        return {{1 - y * y2 - z * z2, x * y2 + w * z2, x * z2 - w * y2},
                {x * y2 - w * z2, 1 - x * x2 - z * z2, y * z2 + w * x2},
                {x * z2 + w * y2, y * z2 - w * x2, 1 - x * x2 - y * y2}};
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
