// wind_field.h: a wind that is not the same everywhere over the ground (§7): cells of a grid, and cylinders on which it turns to and fro.
//
// Grid. In cell c, at the reference height,
//   v_c(t) = V_c (1 + sum_k p_c^k sin(2^k (2 pi f t + phase_c) + psi_k) / sum_k p_c^k) G(t) + Q(t),   k = 0 ... octaves_c - 1
// V_c is the cell's mean velocity (the wind's own where the grid names none), p the persistence; psi_0 = 0, the others come from the seed. So v_c
// swings between 0 and 2 V_c and is periodic with 1 / f. A cell whose phase is ahead has the same gusts earlier: phases that fall along the wind are
// gusts that travel. G and Q are the gusts' factor and the turbulence of the wind as a whole (wind_weather.h), the same in all cells. Outside the
// grid the nearest cell holds. Without a grid there is one cell, whose octaves are 0.
//
// Swirl. The paper turns v by adding h s, s = v x j normalised, and rescaling to |v|. As v and s are at right angles, that is
//   v' = v cos a + |v| s sin a,   h = |v| tan a,   a(r, t) = A(r) sin(2 pi (t / period - r / wavelength))
// for any |a|, with r the distance from the axis and A(r) the monotone cubic through the keys (base/monotone.h), constant beyond them. A wind
// straight up or down stays as it is.
//
// Steps look up (WindField) the velocities of cells and, at even radii, the angle's cosine and sine. These are linear between the radii and brought
// back to length 1, so that the magnitude stays to rounding. Trees that are ahead in the wind (Placement::start) use tables of their own, one set a
// clock, which hold the wind of t + start; gusts and turbulence are ahead too. The radii are as close as a 64th of a wavelength, of the distance
// between two keys and of the way to the farthest body. Beyond that body the angle is constant.
#pragma once
#include "../model/scene.h"
#include "field_shape.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace bough {

// True if bodies must know where over the ground they are.
inline bool varies_over_ground(const Wind& wind) {
    return wind.grid || wind.swirl || wind.shelter;
}
// Returns the parts of the wind that make it so, as JSON pointers.
std::vector<const char*> parts_over_ground(const Wind&);
// True if the wind blows, and always and everywhere in one direction, apart from turbulence.
inline bool one_way(const Wind& wind) {
    return !wind.grid && !wind.swirl && !wind.velocity.isZero(0);
}
// True if it is more than still air.
bool blows(const Wind&);
// True if it blows the same at all times.
bool steady(const Wind&);

// Returns v turned about the vertical by the angle of cosine c and sine s. A v straight up stays.
template <class T> Vector3<T> swirled(const Vector3<T>& v, T c, T s) {
    const T flat = v.x() * v.x() + v.z() * v.z();
    if (!(flat > T(1e-30))) return v;
    const T k = s * std::sqrt((flat + v.y() * v.y()) / flat);
    return {c * v.x() - k * v.z(), c * v.y(), c * v.z() + k * v.x()};
}

// Returns the clocks of a scene's trees: every start that a tree has, once, 0 first; only 0 where no tree is ahead.
std::vector<double> wind_clocks(const Scene&);

// Returns the cell of a grid that holds for the place (x, z) [m]. Cells at the border hold for all beyond them.
inline std::size_t cell_at(const WindGrid& grid, double x, double z) {
    const auto along = [&](double place, std::int32_t count) {
        return std::size_t(std::clamp(std::floor(place * (1 / grid.cell)), 0.0, double(count - 1)));
    };
    return along(z - grid.z, grid.rows) * std::size_t(grid.columns) + along(x - grid.x, grid.columns);
}

// Returns the cell's value of a list that has one value, or one for each cell.
template <class A> const A& of_cell(const std::vector<A>& list, std::size_t cell) {
    return list.size() == 1 ? list.front() : list[cell];
}

// [m/s] Returns the mean velocity at a place [m] of the wind as a whole, without the effect of cells and turns.
Vec3 mean_wind(const Wind&, const Vec3& place);

template <class T> struct WindField {
    FieldShape<T> shape;
    // [m/s] of each clock's cells where the profile is 1: all x, all y, all z; empty: no field at all
    std::vector<T> velocity;
    std::vector<T> turn;               // of each clock's rings: cosines, then sines; empty: no swirl
    std::vector<double> ahead, behind; // [rad] A(r) times cosine and sine of 2 pi r / wavelength

    std::vector<double> clock{0}; // [s] by how much each is ahead

    bool on() const { return !velocity.empty(); }

    Vector3<T> at(T px, T pz, std::size_t which = 0) const {
        // A place that is not a number, in a run that diverges, is taken as the first cell: max keeps its first argument.
        const auto along = [](T place, std::int32_t count) {
            return std::size_t(std::min(std::max(T(0), place), T(count - 1)));
        };
        const FieldShape<T>& s = shape;
        const std::size_t n = velocity.size() / 3,
                          k = which * std::size_t(s.cells) +
                              along((pz - s.z) * s.per_metre, s.rows) * std::size_t(s.columns) +
                              along((px - s.x) * s.per_metre, s.columns);
        const Vector3<T> v(velocity[k], velocity[n + k], velocity[2 * n + k]);
        if (turn.empty()) return v;
        const T dx = px - s.center_x, dz = pz - s.center_z;
        const T place = std::min(std::max(T(0), std::sqrt(dx * dx + dz * dz) * s.rings_per_metre), T(s.rings - 1));
        const std::size_t ring = std::min(std::size_t(place), std::size_t(s.rings - 2));
        const T w = place - T(ring);
        const T* cosines = turn.data() + which * std::size_t(s.rings) + ring;
        const T* sines = cosines + turn.size() / 2;
        const T cosine = cosines[0] + w * (cosines[1] - cosines[0]), sine = sines[0] + w * (sines[1] - sines[0]);
        const T one = 1 / std::sqrt(cosine * cosine + sine * sine);
        return swirled<T>(v, one * cosine, one * sine);
    }
};

// reach: [m] how far from the swirl's axis bodies can be. Throws std::domain_error if that takes more entries than there may be, or if cells times
// clocks do.
template <class T> WindField<T> make_wind_field(const Wind&, double reach, const std::vector<double>& clocks = {0});
// Fills in velocities and turns at time t. O(clocks (cells octaves + rings)). Allocates nothing.
template <class T> void evaluate_field(const Wind&, double t, WindField<T>&);

} // namespace bough
