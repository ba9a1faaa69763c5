#include "wind_weather.h"
#include "../base/angles.h"
#include <array>

namespace bough {
namespace {

constexpr int waves = 24;

// SplitMix64: a well-spread 64-bit value for each counter.
std::uint64_t scramble(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double phase(std::uint64_t seed, int component, int wave) {
    const std::uint64_t bits = scramble(scramble(seed) + std::uint64_t(component * waves + wave));
    return two_pi * double(bits >> 11) * 0x1.0p-53;
}

double gust(double s) {
    const double mean = 0.30850832255367105; // e^-2 I0(2)
    return (std::exp(2 * (std::cos(two_pi * s) - 1)) - mean) / (1 - mean);
}

// q(t). period: after which it repeats, where it does.
Vec3 turbulence(std::uint64_t seed, double speed, double t, const std::optional<double>& period) {
    const double scale = speed / 10;
    const double lowest = 0.02 * scale, ratio = std::pow(250.0, 1.0 / (waves - 1));
    std::array<double, waves> frequency, power;
    double total = 0;
    for (int w = 0; w < waves; ++w) {
        frequency[std::size_t(w)] = lowest * std::pow(ratio, w);
        const double n = frequency[std::size_t(w)] * 50 / speed;
        power[std::size_t(w)] = n / std::pow(1 + 1.5 * n, 5.0 / 3.0); // per unit of log frequency, which is even here
        total += power[std::size_t(w)];
    }
    if (period) {
        std::size_t first = 0; // of those that come to the same frequency
        for (std::size_t w = 0; w < frequency.size(); ++w) {
            frequency[w] = std::max(1.0, std::round(frequency[w] * *period)) / *period;
            if (frequency[w] != frequency[first]) first = w;
            if (w == first) continue;
            power[first] += power[w];
            power[w] = 0;
        }
    }
    Vec3 q = Vec3::Zero();
    for (int c = 0; c < 3; ++c)
        for (int w = 0; w < waves; ++w)
            q[c] += std::sqrt(2 * power[std::size_t(w)] / total) *
                    std::cos(two_pi * frequency[std::size_t(w)] * t + phase(seed, c, w));
    return q;
}

double gust_factor(const Wind& wind, double t) {
    return 1 + (wind.gust_factor - 1) * gust((t + wind.gust_ahead) / whole_period(wind, wind.gust_period));
}

// The turbulence of a wind that has a mean velocity.
Vec3 turbulent(const Wind& wind, double speed, double t) {
    const Vec3 along = wind.velocity / speed;
    const Vec3 side = Vec3::UnitY().cross(along);
    // A wind straight up or down has no side of its own: take x.
    const Vec3 across = side.norm() > 1e-9 ? Vec3(side.normalized()) : Vec3(Vec3::UnitX());
    const Vec3 q = turbulence(wind.seed, speed, t + wind.turbulence_ahead, wind.period);
    return speed * wind.turbulence * (q[0] * along + 0.75 * q[1] * across + 0.5 * q[2] * along.cross(across));
}

} // namespace

Vec3 wind_velocity(const Wind& wind, double t) {
    const double speed = wind.velocity.norm();
    Vec3 v = wind.velocity;
    if (speed == 0) return v;
    if (wind.gust_factor != 1) v *= gust_factor(wind, t);
    if (wind.turbulence != 0) v += turbulent(wind, speed, t);
    return v;
}

WindWeather wind_weather(const Wind& wind, double t) {
    const double speed = wind.velocity.norm();
    WindWeather weather;
    if (wind.gust_factor != 1) weather.gust = gust_factor(wind, t);
    if (wind.turbulence != 0 && speed > 0) weather.turbulence = turbulent(wind, speed, t);
    return weather;
}

void go_on(const Wind& before, double t, Wind& wind) {
    wind.turbulence_ahead = wind.gust_ahead = 0;
    if (wind.period) return;
    const double speed = wind.velocity.norm();
    if (speed > 0) wind.turbulence_ahead = (t + before.turbulence_ahead) * (before.velocity.norm() / speed) - t;
    wind.gust_ahead = (t + before.gust_ahead) * (wind.gust_period / before.gust_period) - t;
}

double octave_phase(std::uint64_t seed, int octave) {
    return phase(seed, 3, octave); // beside the three components of the turbulence
}

double wind_profile(const Wind& wind, double y) {
    if (wind.profile == 0) return 1;
    return y > 0 ? std::pow(y / wind.reference_height, wind.profile) : 0;
}

double wind_factor(const Wind& wind, const Vec3& place) {
    return wind_profile(wind, place.y());
}

} // namespace bough
