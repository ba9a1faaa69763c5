// wind_at.h: the wind's definition (lib/laws/wind_weather.h, wind_field.h), evaluated at one place. The tables that steps look up are held against it.
#pragma once
#include "lib/base/monotone.h"
#include "lib/laws/wind.h"
#include <numbers>

namespace bough {

// [m/s] Of a wind that varies over the ground, where the profile is 1.
inline Vec3 field_at(const Wind& wind, double x, double z, double t) {
    constexpr double whole_turn = 2 * std::numbers::pi;
    const WindWeather weather = wind_weather(wind, t);
    Vec3 v = weather.gust * wind.velocity + weather.turbulence;
    if (wind.grid) {
        const WindGrid& grid = *wind.grid;
        const std::size_t cell = cell_at(grid, x, z);
        const Vec3& mean = grid.velocity.empty() ? wind.velocity : of_cell(grid.velocity, cell);
        const double angle = whole_turn * t / whole_period(wind, 1 / grid.frequency) + of_cell(grid.phase, cell);
        double sum = 0, total = 0;
        for (int k = 0; k < of_cell(grid.octaves, cell); ++k) {
            const double amplitude = std::pow(of_cell(grid.persistence, cell), k);
            sum += amplitude * std::sin(std::ldexp(angle, k) + (k == 0 ? 0 : octave_phase(wind.seed, k)));
            total += amplitude;
        }
        v = (1 + (total > 0 ? sum / total : 0)) * weather.gust * mean + weather.turbulence;
    }
    if (!wind.swirl) return v;
    const WindSwirl& swirl = *wind.swirl;
    const double r = std::hypot(x - swirl.x, z - swirl.z), waves = swirl.wavelength ? r / *swirl.wavelength : 0;
    const double a = whole_turn / 360 * monotone_cubic(swirl.radius, swirl.angle, r) *
                     std::sin(whole_turn * (t / whole_period(wind, swirl.period) - waves));
    return swirled(v, std::cos(a), std::sin(a));
}

// [m/s] At a place [m] and time [s]: undisturbed, without shelter.
inline Vec3 wind_at(const Wind& wind, const Vec3& place, double t) {
    return wind_factor(wind, place) *
           (varies_over_ground(wind) ? field_at(wind, place.x(), place.z(), t) : wind_velocity(wind, t));
}

} // namespace bough
