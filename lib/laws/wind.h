// wind.h: the wind's velocity. Each step evaluates it once into tables over height and over the ground, in which bodies look it up.
#pragma once
#include "wind_field.h"
#include "wind_weather.h"

namespace bough {

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
