// coupled_parts.h: what the coupled step's sweeps over lanes share: their rows, and where a joint is half a step on.
#pragma once
#include "../lanes/sweep_parts.h"
#include "coupled_rows.h"
#include "turn_bounds.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class T> struct CoupledParts : SweepParts<T, CoupledRows<T>> {
    using Base = SweepParts<T, CoupledRows<T>>;
    using Base::L, Base::rows, Base::constants_row;
    using typename Base::W;

    using Base::Base;

    Rows<const T> constants(std::uint32_t row, int lane) const {
        return {rows.constants + (constants_row(row) * std::size_t(constant::count)) * L + lane};
    }
    Rows<const T> now(std::uint32_t row, int lane) const {
        return {rows.now + std::ptrdiff_t(row - rows.first_row) * rows.now_stride * L + lane};
    }
    Rows<T> next(std::uint32_t row, int lane) const {
        return {rows.next + std::ptrdiff_t(row - rows.first_row) * rows.next_stride * L + lane};
    }
    Rows<T> solved_row(std::uint32_t row, int lane) const {
        return {rows.solved_rows + std::ptrdiff_t(row - rows.first_row) * rows.solved_stride * L + lane};
    }

    // Returns the square of the rate from which on the energy guard looks at a body's tree.
    W fast2(bool wood) const {
        const T most = T(wood ? watched_turn : watched_end_turn) / rows.h;
        return all(most * most);
    }
    [[gnu::noinline]] void mark(std::uint32_t base, int lane, W rate2, bool wood, SweepFlags& flags) const {
        flags.fast = true;
        const W most = fast2(wood);
        for (int l = 0; l < width<T>; ++l)
            if (rate2[l] > most[l]) rows.watched[base + std::uint32_t(lane + l)] |= wood ? 1 : 2;
    }

    // Returns half of the last changes; zero for joints whose way on cannot be told (midpoint.h). turn: the parent's.
    BOUGH_FORCE static void halfway(const Rows<const T>& y0, const M3<W>& G, const V3<W>& turn, V3<W>& half,
                                    V3<W>& half_rate) {
        half = T(0.5) * y0.vector(motion::theta_change);
        half_rate = T(0.5) * y0.vector(motion::theta_dot_change);
        const V3<W> half_turn = turn + G * half;
        const W own_way = dot(half, half), way = dot(half_turn, half_turn);
        const W own_most = all(T(extrapolated_turn / 2) * T(extrapolated_turn / 2)),
                most = all(T(extrapolated_turn) * T(extrapolated_turn));
        if (!any_above(own_way, own_most) && !any_above(way, most)) return;
        const W one = where_above(own_most, own_way, where_above(most, way, all(T(1))));
        half = one * half;
        half_rate = one * half_rate;
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
