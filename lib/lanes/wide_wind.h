// wide_wind.h: the wind at bodies in lanes. WindTable and WindField (laws/wind.h, wind_field.h) and plan/body_air.h look it up for one body; it is
// written a second time because tables are looked up for all lanes at once. It is the one place in lanes that knows how a wind varies in space:
// sweeps ask for wind_on. tests/lib/laws/wind_field_steps.cpp and the solvers' lanes.cpp hold the two together.
#pragma once
#include "sweep_rows.h"
#include "wide_pair.h"
#include "wide_rows.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// Given is a SweepRows and more.
template <class T, class Given> struct WideWind {
    using W = Wide<T>;
    static constexpr int L = lanes<T>;

    const Given& rows;

    explicit WideWind(const Given& r) : rows(r) {}

    // Where in the field's tables a place over the ground stands (WindField::at).
    struct OverGround {
        typename Bits<T>::Wide cell, ring;
        W weight; // of the ring after
    };
    // At a body: the factor on all of the wind (WindTable::factor, shelter), and where the wind that it scales stands.
    struct WindOn {
        W factor;
        OverGround over;
    };
    BOUGH_FORCE WindOn wind_on(const W& y) const { return {profile(y), OverGround{}}; }
    // For a wind that varies over the ground, on the bodies of a row whose centres of mass are there.
    BOUGH_FORCE WindOn wind_on(std::uint32_t row, int lane, const W& x, const W& y, const W& z) const {
        const W factor = profile(y);
        return {sheltered(row, lane, factor), over_ground(row, lane, x, z)};
    }

    // Returns the wind there where the profile is 1.
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
        // A wind straight up or down stays. (The choice is not a sum of products, which targets with masks would fuse differently from the others.)
        const W flat = v.x * v.x + v.z * v.z, all_of_it = flat + v.y * v.y, least = all(T(1e-30));
        const W c_v = choose_above(flat, least, W(one * cosine), all(T(1))),
                s_v = choose_above(flat, least, W(one * sine), W{}),
                steep = choose_above(flat, least, W(all_of_it / larger(flat, least)), all(T(1)));
        const W k = s_v * root(steep);
        return {c_v * v.x - k * v.z, c_v * v.y, c_v * v.z + k * v.x};
    }

private:
    // Returns the wind's profile at height y: linear between even heights, constant beyond. The lanes' places are looked up at once.
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

    // Returns the integer below `place`, 0 <= place < 2^22.
    BOUGH_FORCE static W floor_of(const W& place) {
        const W nearest = W(place + Bits<T>::rounder) - Bits<T>::rounder;
        return nearest - where_above(nearest, place, all(T(1)));
    }
    BOUGH_FORCE static auto index_of(const W& whole) {
        using B = Bits<T>;
        return typename B::Wide(W(whole + B::rounder)) & 0x3fffff;
    }
    // Returns the place clamped; NaN gives 0.
    BOUGH_FORCE static W within(const W& place, std::int32_t most) { return smaller(larger(place, W{}), all(T(most))); }

    BOUGH_FORCE OverGround over_ground(std::uint32_t body_row, int lane, const W& x, const W& z) const {
        const FieldRows<T>& f = rows.field;
        const FieldShape<T>& s = f.shape;
        OverGround at{};
        const W column = floor_of(within(W((x - s.x) * s.per_metre), s.columns - 1)),
                row = floor_of(within(W((z - s.z) * s.per_metre), s.rows - 1));
        const W clock = f.clock ? read(f.clock + body_row * std::size_t(L) + lane) : W{};
        at.cell = index_of(W(clock * T(s.cells) + (row * T(s.columns) + column)));
        if (!f.middle.turn) return at;
        const W dx = x - s.center_x, dz = z - s.center_z;
        const W place = within(W(root(W(dx * dx + dz * dz)) * s.rings_per_metre), s.rings - 1);
        const W ring = smaller(floor_of(place), all(T(s.rings - 2)));
        at.ring = index_of(W(clock * T(s.rings) + ring));
        at.weight = place - ring;
        return at;
    }
    BOUGH_FORCE W sheltered(std::uint32_t row, int lane, const W& factor) const {
        const T* shelter = rows.field.shelter;
        return shelter ? W(factor * read(shelter + row * std::size_t(L) + lane)) : factor;
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
