// sweep_parts.h: what the sweeps of both steps over lanes share: constants, the wind and the air.
//
// The air's law (laws/air.h) and the look-up of the wind (laws/wind.h, wind_field.h) stand here a second time: a kind is known for a whole group of
// rows, speed and its inverse are worked out once and early for force, damping and turning together, and tables are looked up for all lanes at once.
// Each of the scalar's functions takes a root and a quotient of its own. The lanes' tests hold the two together.
#pragma once
#include "../laws/air_constants.h"
#include "wide_maps.h"
#include "wide_pair.h"
#include "wide_rows.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// Lines [from, to) of what the next row will read; beyond the last one, nothing happens. A row asks for them few at a time among its
// arithmetic: all at once fill the core's queue of misses, and what the row itself reads waits behind them. The barrier keeps the compiler
// from gathering them.
template <int from, int to, class T> BOUGH_FORCE void prefetch(const T* at) {
#pragma GCC unroll 64
    for (int k = from; k < to; ++k) __builtin_prefetch(at + k * lanes<T>);
    __asm__ volatile("");
}

// What stands in memory is read from there again, where the compiler would rather keep it on its stack.
BOUGH_FORCE void forget_memory() {
    __asm__ volatile("" ::: "memory");
}

// Given: what the sweeps of one step read and write, a SweepRows and more.
template <class T, class Given> struct SweepParts {
    using W = Wide<T>;
    using C = Complex<W>;
    static constexpr int L = lanes<T>;
    // Of an angle that may be past half a turn: a little below pi squared, the rest is seen body by body.
    static constexpr T about_half_turn2 = T(9.869);
    // Sums of squares of angles and rates above are taken for numbers that are none, or soon will be.
    static constexpr T still_finite2 = T(1e30);

    const Given& rows;

    explicit SweepParts(const Given& r) : rows(r) {}

    static C number(const T (&z)[2]) { return {all(z[0]), all(z[1])}; }
    static V3<W> vector(const T (&v)[3]) { return {all(v[0]), all(v[1]), all(v[2])}; }

    // Where the constants of a row stand (shared_constants.h). It may be the row beyond the last, of which nothing is read.
    BOUGH_FORCE std::size_t constants_row(std::uint32_t row) const {
        return rows.constants_row ? rows.constants_row[row] : row;
    }

    // Parent's body frame from joint frame.
    BOUGH_FORCE static M3<W> joint_rotation(const Rows<const T>& k) {
        const W w = k.real(body_constant::R_pj), x = k.real(body_constant::R_pj + 1),
                y = k.real(body_constant::R_pj + 2), z = k.real(body_constant::R_pj + 3);
        const W x2 = x + x, y2 = y + y, z2 = z + z;
        return {{1 - y * y2 - z * z2, x * y2 + w * z2, x * z2 - w * y2},
                {x * y2 - w * z2, 1 - x * x2 - z * z2, y * z2 + w * x2},
                {x * z2 + w * y2, y * z2 - w * x2, 1 - x * x2 - y * y2}};
    }

    // Wind's profile at height y: linear between even heights, constant beyond; the lanes' places looked up at once.
    BOUGH_FORCE W profile(const W& y) const {
        using B = Bits<T>;
        const std::size_t last = rows.profile_entries - 1;
        if (last == 0) return all(rows.profile[0]);
        const W place = smaller(larger(W(y * rows.per_metre), W{}), all(T(last))); // NaN: 0
        const W rounded = smaller(W(place - T(0.5)), all(T(last - 1))) + B::rounder;
        const typename B::Wide k = typename B::Wide(rounded) & 0x3fffff;
        const W low = look_up(rows.profile, k), high = look_up(rows.profile + 1, k);
        return low + (place - (rounded - B::rounder)) * (high - low);
    }

    // The integer below, of 0 <= place < 2^22.
    BOUGH_FORCE static W floor_of(const W& place) {
        const W nearest = W(place + Bits<T>::rounder) - Bits<T>::rounder;
        return nearest - where_above(nearest, place, all(T(1)));
    }
    BOUGH_FORCE static auto index_of(const W& whole) {
        using B = Bits<T>;
        return typename B::Wide(W(whole + B::rounder)) & 0x3fffff;
    }
    // Clamped; NaN: 0.
    BOUGH_FORCE static W within(const W& place, std::int32_t most) { return smaller(larger(place, W{}), all(T(most))); }

    // Where in the field's tables a place over the ground stands (WindField::at).
    struct OverGround {
        typename Bits<T>::Wide cell, ring;
        W weight; // of the ring after
    };
    BOUGH_FORCE OverGround over_ground(std::uint32_t body_row, int lane, const W& x, const W& z) const {
        const FieldRows<T>& f = rows.field;
        OverGround at{};
        const W column = floor_of(within(W((x - f.x) * f.per_metre), f.columns - 1)),
                row = floor_of(within(W((z - f.z) * f.per_metre), f.rows - 1));
        const W clock = f.clock ? read(f.clock + body_row * std::size_t(L) + lane) : W{};
        at.cell = index_of(W(clock * T(f.cells) + (row * T(f.columns) + column)));
        if (!f.middle.turn) return at;
        const W dx = x - f.center_x, dz = z - f.center_z;
        const W place = within(W(root(W(dx * dx + dz * dz)) * f.rings_per_metre), f.rings - 1);
        const W ring = smaller(floor_of(place), all(T(f.rings - 2)));
        at.ring = index_of(W(clock * T(f.rings) + ring));
        at.weight = place - ring;
        return at;
    }
    // The wind there where the profile is 1.
    BOUGH_FORCE V3<W> field_at(const OverGround& at, const FieldTables<T>& tables) const {
        const FieldRows<T>& f = rows.field;
        const V3<W> v{look_up(tables.velocity, at.cell), look_up(tables.velocity + f.all_cells, at.cell),
                      look_up(tables.velocity + 2 * std::ptrdiff_t(f.all_cells), at.cell)};
        if (!tables.turn) return v;
        const T *c = tables.turn, *s = c + f.all_rings;
        const W c_0 = look_up(c, at.ring), s_0 = look_up(s, at.ring);
        const W cosine = c_0 + at.weight * (look_up(c + 1, at.ring) - c_0),
                sine = s_0 + at.weight * (look_up(s + 1, at.ring) - s_0);
        const W one = 1 / root(W(cosine * cosine + sine * sine));
        // A wind straight up or down stays. (What is chosen is no sum of products, which targets with masks would not fuse as the others do.)
        const W flat = v.x * v.x + v.z * v.z, all_of_it = flat + v.y * v.y, least = all(T(1e-30));
        const W c_v = choose_above(flat, least, W(one * cosine), all(T(1))),
                s_v = choose_above(flat, least, W(one * sine), W{}),
                steep = choose_above(flat, least, W(all_of_it / larger(flat, least)), all(T(1)));
        const W k = s_v * root(steep);
        return {c_v * v.x - k * v.z, c_v * v.y, c_v * v.z + k * v.x};
    }
    BOUGH_FORCE W sheltered(std::uint32_t row, int lane, const W& factor) const {
        const T* shelter = rows.field.shelter;
        return shelter ? W(factor * read(shelter + row * std::size_t(L) + lane)) : factor;
    }

    struct Speed {
        W speed, inverse;
    }; // [m/s] of the air that drags, and 1 over it, finite where it is 0
    // Of the air at velocity u past the body. Apart from air(), so that what does not wait for it can go in between.
    template <Kind kind> BOUGH_FORCE static Speed air_speed(const V3<W>& u, const M3<W>& R) {
        V3<W> across = u;
        if constexpr (kind == Kind::branch) across = u - dot(u, R.z) * R.z;
        const W speed = root(dot(across, across));
        return {speed, 1 / larger(speed, all(T(1e-30)))};
    }

    struct Air {
        V3<W> force; // [N] with the drag of the velocity ahead
        Symmetric<W> D;
    };

    // 1 / fold_speed for what folds (air.h), else 0: a clump is a fruit but for that.
    static constexpr T fold_of(Kind kind) { return is_foliage(kind) ? T(1 / fold_speed) : T(0); }
    // g
    BOUGH_FORCE static W unfolded(T fold, const W& speed) { return 1 / (1 + fold * speed); }

    // air.h
    template <Kind kind>
    BOUGH_FORCE static Air air(const V3<W>& u, const Speed& s, const V3<W>& ahead, const M3<W>& R, const W& scale,
                               Symmetric<W>& H, const W& arm, T fold) {
        Air out;
        W one = scale * s.speed, more = scale * s.inverse;
        if constexpr (kind != Kind::branch) {
            const W g = unfolded(fold, s.speed);
            one = g * one;
            more = g * g * more;
        }
        if constexpr (kind == Kind::leaf) {
            const V3<W>&n = R.y, &x = R.x;
            const W along = dot(u, n);
            const T across = T(1 - streaming_drag), all_ways = T(streaming_drag);
            const W s_one = all_ways * one;
            const V3<W> dn = W(across * (one + more * along * along)) * n, du = W(all_ways * more) * u;
            out.D = {s_one + du.x * u.x + dn.x * n.x, du.x * u.y + dn.x * n.y, du.x * u.z + dn.x * n.z,
                     s_one + du.y * u.y + dn.y * n.y, du.y * u.z + dn.y * n.z, s_one + du.z * u.z + dn.z * n.z};
            out.force = W(across * one * along) * n + s_one * u + out.D * ahead;
            const V3<W> hx = W(2 * across * one * arm * s.speed) * x;
            H = H + Symmetric<W>{hx.x * x.x, hx.x * x.y, hx.x * x.z, hx.y * x.y, hx.y * x.z, hx.z * x.z};
        } else {
            V3<W> across = u;
            const V3<W>& t = R.z;
            if constexpr (kind == Kind::branch) across = u - dot(u, t) * t;
            const V3<W> m = more * across;
            out.D = {one + m.x * across.x, m.x * across.y, m.x * across.z,
                     one + m.y * across.y, m.y * across.z, one + m.z * across.z};
            if constexpr (kind == Kind::branch) {
                const V3<W> s_t = one * t;
                out.D =
                    out.D - Symmetric<W>{s_t.x * t.x, s_t.x * t.y, s_t.x * t.z, s_t.y * t.y, s_t.y * t.z, s_t.z * t.z};
            }
            out.force = one * across + out.D * ahead;
        }
        return out;
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
