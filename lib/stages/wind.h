// wind.h: the wind's velocity, evaluated once a step into a table over height that bodies look theirs up in.
//
// The definition is at struct Wind (scene.h). g(s) = (e^(2 (cos 2 pi s - 1)) - m) / (1 - m), m its mean e^-2 I0(2): one
// crest a period, mean 0, peak 1. q(t) is a sum of 24 cosines a component, frequencies even in the logarithm from 0.02 to
// 5 Hz times (|V| / 10 m/s), amplitudes by Kaimal's spectrum f S ~ n / (1 + 1.5 n)^(5/3), n = f 50 m / |V|, phases from the
// seed; unit variance over long times.
#pragma once
#include "../model/scene.h"
#include <vector>

namespace bough {

// Velocity at the reference height [m/s] at time t [s]. O(1).
Vec3 wind_velocity(const Wind&, double t);

// Factor over height, (y / reference_height)^profile, 0 at and below the ground (1 everywhere for profile 0).
double wind_profile(const Wind&, double y);

// The wind's velocity [m/s] at a place [m] and time [s], evaluated directly: the definition, for bodies that are few and for tests;
// what steps look up is the table below. O(1).
Vec3 wind_at(const Wind&, const Vec3& place, double t);

// The field as bodies see it: velocities at even heights from 0 to top, linear between, constant above.
template <class T> struct WindTable {
    T per_metre = 0;                  // [1/m] entries a metre
    std::vector<Vector3<T>> velocity; // [m/s]
    std::vector<T> profile;           // factor at each entry, set up once

    Vector3<T> at(T y) const {
        // A y that is not a number, in a run that diverges, is the ground: max keeps its first argument.
        const T place = std::min(std::max(T(0), y * per_metre), T(velocity.size() - 1));
        const auto k = std::min(std::size_t(place), velocity.size() - 1 - (velocity.size() > 1));
        if (velocity.size() == 1) return velocity[0];
        const T w = place - T(k);
        return velocity[k] + w * (velocity[k + 1] - velocity[k]);
    }
};

// Table for a scene whose highest body reaches `top` [m]: one entry for a uniform field, else 65.
template <class T> WindTable<T> make_wind_table(const Wind&, double top);
// Fills in the velocities at time t. O(entries). Allocates nothing.
template <class T> void evaluate_wind(const Wind&, double t, WindTable<T>&);

} // namespace bough
