#include "wind_field.h"
#include "../base/angles.h"
#include "../base/monotone.h"
#include "wind_weather.h"
#include <array>
#include <stdexcept>
#include <string>

namespace bough {
namespace {

constexpr std::size_t most_octaves = 32;
constexpr double most_rings = 1 << 22; // what lanes look up (wide_pair.h)
constexpr std::size_t most_entries = 1 << 22;

// Cosine and sine of psi_k.
struct OctavePhases {
    std::array<double, most_octaves> c, s;
    explicit OctavePhases(std::uint64_t seed) {
        for (std::size_t k = 0; k < most_octaves; ++k) {
            const double psi = k == 0 ? 0 : octave_phase(seed, int(k));
            c[k] = std::cos(psi);
            s[k] = std::sin(psi);
        }
    }
};

// 1 + the octaves, at the angle 2 pi f t + phase.
double swell(int octaves, double persistence, double angle, const OctavePhases& psi) {
    if (octaves == 0) return 1;
    double c = std::cos(angle), s = std::sin(angle), sum = 0, total = 0, amplitude = 1;
    for (std::size_t k = 0; k < std::size_t(octaves); ++k) {
        sum += amplitude * (s * psi.c[k] + c * psi.s[k]);
        total += amplitude;
        amplitude *= persistence;
        const double doubled = 2 * s * c; // each octave twice the angle of the one below
        c = (c - s) * (c + s);
        s = doubled;
    }
    return 1 + sum / total;
}

double turns(double t, double period) { // [1] since the last whole one: of long times little is lost
    const double n = t / period;
    return n - std::floor(n);
}

Vec3 cell_velocity(const Wind& wind, const WindWeather& weather, std::size_t cell, double t, const OctavePhases& psi) {
    const WindGrid& grid = *wind.grid;
    const Vec3& mean = grid.velocity.empty() ? wind.velocity : of_cell(grid.velocity, cell);
    const double angle = two_pi * turns(t, whole_period(wind, 1 / grid.frequency)) + of_cell(grid.phase, cell);
    const double factor = swell(of_cell(grid.octaves, cell), of_cell(grid.persistence, cell), angle, psi);
    return mean * (factor * weather.gust) + weather.turbulence;
}

// A(r) [rad]
double largest_turn(const WindSwirl& swirl, double r) {
    return degree * monotone_cubic(swirl.radius, swirl.angle, r);
}

double outward_angle(const WindSwirl& swirl, double r) {
    return swirl.wavelength ? two_pi * r / *swirl.wavelength : 0;
}

// Entries of the table of turns: no two further apart than the header says.
std::size_t rings(const WindSwirl& swirl, double reach) {
    double apart = reach / 64;
    if (swirl.wavelength) apart = std::min(apart, *swirl.wavelength / 64);
    for (std::size_t k = 1; k < swirl.radius.size(); ++k)
        apart = std::min(apart, (swirl.radius[k] - swirl.radius[k - 1]) / 64);
    const double entries = std::ceil(reach / apart) + 1;
    if (!(entries < most_rings))
        throw std::domain_error("wind/swirl: over the " + std::to_string(reach) +
                                " m that bodies reach from its center, a 64th of its wavelength or of the way between "
                                "two radii asks for more than " +
                                std::to_string(int(most_rings)) + " entries; expected longer ones");
    return std::size_t(entries);
}

} // namespace

bool steady(const Wind& wind) {
    if (wind.turbulence != 0 || wind.gust_factor != 1) return false;
    if (wind.grid && std::any_of(wind.grid->octaves.begin(), wind.grid->octaves.end(), [](int n) { return n > 0; }))
        return false;
    return !wind.swirl ||
           std::all_of(wind.swirl->angle.begin(), wind.swirl->angle.end(), [](double a) { return a == 0; });
}

std::vector<const char*> parts_over_ground(const Wind& wind) {
    std::vector<const char*> parts;
    if (wind.grid) parts.push_back("/wind/grid");
    if (wind.swirl) parts.push_back("/wind/swirl");
    if (wind.shelter) parts.push_back("/wind/shelter");
    return parts;
}

bool blows(const Wind& wind) {
    const std::vector<Vec3>* cells = wind.grid ? &wind.grid->velocity : nullptr;
    return !wind.velocity.isZero() ||
           (cells && std::any_of(cells->begin(), cells->end(), [](const Vec3& v) { return !v.isZero(); }));
}

Vec3 mean_wind(const Wind& wind, const Vec3& place) {
    return wind_factor(wind, place) * wind.velocity;
}

std::vector<double> wind_clocks(const Scene& scene) {
    std::vector<double> clocks{0};
    for (const Placement& tree : scene.trees)
        if (std::find(clocks.begin(), clocks.end(), tree.start) == clocks.end()) clocks.push_back(tree.start);
    return clocks;
}

template <class T> WindField<T> make_wind_field(const Wind& wind, double reach, const std::vector<double>& clocks) {
    WindField<T> field;
    if (!varies_over_ground(wind) && clocks.size() == 1) return field;
    field.clock = clocks;
    FieldShape<T>& shape = field.shape;
    if (wind.grid) {
        shape.x = T(wind.grid->x);
        shape.z = T(wind.grid->z);
        shape.per_metre = T(1 / wind.grid->cell);
        shape.columns = wind.grid->columns;
        shape.rows = wind.grid->rows;
        shape.cells = shape.columns * shape.rows;
    }
    const auto cells = std::size_t(shape.cells);
    if (cells * clocks.size() > most_entries)
        throw std::domain_error("wind/grid: its " + std::to_string(cells) + " cells for each of the " +
                                std::to_string(clocks.size()) + " starts of trees are more than " +
                                std::to_string(most_entries) + " entries; expected fewer cells or starts");
    field.velocity.resize(3 * cells * clocks.size());
    if (!wind.swirl) return field;
    const double far = std::max(reach, 1e-3);
    const std::size_t n = rings(*wind.swirl, far);
    shape.center_x = T(wind.swirl->x);
    shape.center_z = T(wind.swirl->z);
    shape.rings_per_metre = T(double(n - 1) / far);
    shape.rings = std::int32_t(n);
    if (n * clocks.size() > most_entries)
        throw std::domain_error("wind/swirl: its " + std::to_string(n) + " rings for each of the " +
                                std::to_string(clocks.size()) + " starts of trees are more than " +
                                std::to_string(most_entries) + " entries; expected longer waves or fewer starts");
    field.turn.resize(2 * n * clocks.size());
    for (std::size_t k = 0; k < n; ++k) {
        const double r = far * double(k) / double(n - 1), b = outward_angle(*wind.swirl, r);
        field.ahead.push_back(largest_turn(*wind.swirl, r) * std::cos(b));
        field.behind.push_back(largest_turn(*wind.swirl, r) * std::sin(b));
    }
    return field;
}

namespace {

template <class T> void evaluate_clock(const Wind& wind, std::size_t which, double t, WindField<T>& field) {
    const WindWeather weather = wind_weather(wind, t);
    const auto n = std::size_t(field.shape.cells), all = field.velocity.size() / 3;
    const auto put = [&](std::size_t cell, const Vec3& v) {
        for (std::size_t k = 0; k < 3; ++k) field.velocity[k * all + which * n + cell] = T(v[Eigen::Index(k)]);
    };
    if (wind.grid) {
        const OctavePhases psi(wind.seed);
        for (std::size_t cell = 0; cell < n; ++cell) put(cell, cell_velocity(wind, weather, cell, t, psi));
    } else {
        put(0, wind.velocity * weather.gust + weather.turbulence);
    }
    if (!wind.swirl) return;
    const double now = two_pi * turns(t, whole_period(wind, wind.swirl->period)), c = std::cos(now), s = std::sin(now);
    const auto rings = std::size_t(field.shape.rings);
    T* const turn = field.turn.data() + which * rings;
    for (std::size_t k = 0; k < rings; ++k) {
        const double angle = s * field.ahead[k] - c * field.behind[k]; // A sin(now - b)
        turn[k] = T(std::cos(angle));
        turn[field.turn.size() / 2 + k] = T(std::sin(angle));
    }
}

} // namespace

template <class T> void evaluate_field(const Wind& wind, double t, WindField<T>& field) {
    for (std::size_t k = 0; k < field.clock.size(); ++k) evaluate_clock(wind, k, t + field.clock[k], field);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template WindField<T> make_wind_field(const Wind&, double, const std::vector<double>&);                            \
    template void evaluate_field(const Wind&, double, WindField<T>&);
#include "../base/instantiate.inc"

} // namespace bough
