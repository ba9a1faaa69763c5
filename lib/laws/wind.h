// wind.h: the wind's velocity. Each step evaluates it once into tables over height and over the ground, in which bodies look it up.
//
// struct Wind (scene.h) has the definition. g(s) = (e^(2 (cos 2 pi s - 1)) - m) / (1 - m), with m its mean e^-2 I0(2): one crest a period, mean 0,
// peak 1. q(t) is a sum of 24 cosines a component. Their frequencies are even in the logarithm from 0.02 to 5 Hz times (|V| / 10 m/s). Their
// amplitudes follow Kaimal's spectrum f S ~ n / (1 + 1.5 n)^(5/3), n = f 50 m / |V|. Their phases come from the seed. q has unit variance over long
// times. Where the wind repeats (Wind::period), each frequency is the nearest multiple of 1 / period, at least one. Waves that come to the same
// frequency become one wave of their power together, with the phase of the lowest.
#pragma once
#include "wind_field.h"

namespace bough {

// Returns the velocity at the reference height [m/s] at time t [s] of a wind that is the same all over the ground. O(1).
Vec3 wind_velocity(const Wind&, double t);

// Returns the effect of that wind's gusts and turbulence on its velocity. O(1).
WindWeather wind_weather(const Wind&, double t);
// Lets a wind that takes another's place at time t [s] go on with its phases. The phases of turbulence are frequency times time, and every frequency
// goes with the speed, so at another speed another time belongs to the same phases. The same holds for gusts and their period. Without this, 1 % more
// speed after 20 s makes the velocity of a gusty wind jump by metres a second. A wind that repeats (Wind::period) has whole frequencies, and jumps.
// For trees that are ahead in the wind (/trees' start) it jumps by their own share. The result is finite where the speeds are.
void go_on(const Wind& before, double t, Wind&);
// Returns psi_k of wind_field.h [rad].
double octave_phase(std::uint64_t seed, int octave);

// Returns the factor over height, (y / reference_height)^profile: 0 at and below the ground (1 everywhere for profile 0).
double wind_profile(const Wind&, double y);
// Returns the factor at a place [m] on the wind's velocity as the scene states it: all that varies in space by a factor. WindTable::factor looks the
// same up in a table, WideWind (lanes/wide_wind.h) in lanes.
double wind_factor(const Wind&, const Vec3& place);

// The wind as bodies see it: velocities at even heights from 0 to top, linear between them, constant above. Where the wind varies over the ground, it
// is the profile's factor at those heights times the field's velocity there.
template <class T> struct WindTable {
    T per_metre = 0;                  // [1/m] entries a metre
    std::vector<Vector3<T>> velocity; // [m/s]; empty where there is a field
    std::vector<T> profile;           // factor at each entry, set up once
    WindField<T> field;

    Vector3<T> at(T y) const {
        // A y that is not a number, in a run that diverges, is taken as the ground: max keeps its first argument.
        const T place = std::min(std::max(T(0), y * per_metre), T(velocity.size() - 1));
        const auto k = std::min(std::size_t(place), velocity.size() - 1 - (velocity.size() > 1));
        if (velocity.size() == 1) return velocity[0];
        const T w = place - T(k);
        return velocity[k] + w * (velocity[k + 1] - velocity[k]);
    }
    T factor(const Vector3<T>& at) const { return profile_at(at.y()); } // wind_factor
    T profile_at(T y) const {
        const T place = std::min(std::max(T(0), y * per_metre), T(profile.size() - 1));
        if (profile.size() == 1) return profile[0];
        const auto k = std::min(std::size_t(place), profile.size() - 2);
        return profile[k] + (place - T(k)) * (profile[k + 1] - profile[k]);
    }
    // clock: which of the field's clocks.
    Vector3<T> at(const Vector3<T>& place, std::size_t clock = 0) const {
        if (!field.on()) return at(place.y());
        return factor(place) * field.at(place.x(), place.z(), clock);
    }
};

// Makes the table for a scene whose highest body reaches `top` [m], and whose farthest body is `reach` [m] from the swirl's axis (needed only with a
// swirl). It has one entry over height for profile 0, else 65. Throws as make_wind_field.
template <class T>
WindTable<T> make_wind_table(const Wind&, double top, double reach = 0, const std::vector<double>& clocks = {0});
// Fills in the velocities at time t. O(entries). Allocates nothing.
template <class T> void evaluate_wind(const Wind&, double t, WindTable<T>&);

} // namespace bough
