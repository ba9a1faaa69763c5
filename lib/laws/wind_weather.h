// wind_weather.h: the wind as a whole over time, and its profile over height: what of it is the same all over the ground.
//
// struct Wind (scene.h) has the definition. g(s) = (e^(2 (cos 2 pi s - 1)) - m) / (1 - m), with m its mean e^-2 I0(2): one crest a period, mean 0,
// peak 1. q(t) is a sum of 24 cosines a component. Their frequencies are even in the logarithm from 0.02 to 5 Hz times (|V| / 10 m/s). Their
// amplitudes follow Kaimal's spectrum f S ~ n / (1 + 1.5 n)^(5/3), n = f 50 m / |V|. Their phases come from the seed. q has unit variance over long
// times. Where the wind repeats (Wind::period), each frequency is the nearest multiple of 1 / period, at least one. Waves that come to the same
// frequency become one wave of their power together, with the phase of the lowest.
#pragma once
#include "../model/scene.h"
#include <algorithm>
#include <cmath>

namespace bough {

// The wind as a whole at one time.
struct WindWeather {
    double gust = 1;                // [1] G
    Vec3 turbulence = Vec3::Zero(); // [m/s] Q
};

// Returns a period as it is taken: where the wind repeats, the nearest period that goes a whole number of times into Wind::period.
inline double whole_period(const Wind& wind, double period) {
    return wind.period ? *wind.period / std::max(1.0, std::round(*wind.period / period)) : period;
}

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

} // namespace bough
