#include "wind.h"
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

template <class T>
WindTable<T> make_wind_table(const Wind& wind, double top, double reach, const std::vector<double>& clocks) {
    const std::size_t entries = wind.profile == 0 ? 1 : 65;
    WindTable<T> table;
    table.per_metre = T(double(entries - 1) / std::max(top, 1e-3));
    table.field = make_wind_field<T>(wind, reach, clocks);
    if (!table.field.on()) table.velocity.resize(entries);
    for (std::size_t k = 0; k < entries; ++k)
        table.profile.push_back(
            T(entries == 1 ? 1 : wind_profile(wind, std::max(top, 1e-3) * double(k) / double(entries - 1))));
    return table;
}

template <class T> void evaluate_wind(const Wind& wind, double t, WindTable<T>& table) {
    if (table.field.on()) return evaluate_field(wind, t, table.field);
    const Vector3<T> v = wind_velocity(wind, t).template cast<T>();
    for (std::size_t k = 0; k < table.velocity.size(); ++k) table.velocity[k] = table.profile[k] * v;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template WindTable<T> make_wind_table(const Wind&, double, double, const std::vector<double>&);                    \
    template void evaluate_wind(const Wind&, double, WindTable<T>&);
#include "../base/instantiate.inc"

std::optional<Wind> wind_preset(const std::string& name) {
    struct Row {
        const char* name;
        double speed, turbulence, gust_factor, gust_period;
    };
    // Turbulence intensities over open country and gust factors of the Beaufort classes these speeds stand for.
    static constexpr Row rows[] = {{"calm", 1, 0.10, 1.2, 8},
                                   {"breeze", 4, 0.15, 1.4, 7},
                                   {"gusty", 8, 0.20, 1.7, 6},
                                   {"storm", 20, 0.22, 1.6, 5}};
    for (const Row& row : rows) {
        if (name != row.name) continue;
        Wind wind;
        wind.velocity = Vec3(row.speed, 0, 0);
        wind.turbulence = row.turbulence;
        wind.gust_factor = row.gust_factor;
        wind.gust_period = row.gust_period;
        return wind;
    }
    return std::nullopt;
}

} // namespace bough
