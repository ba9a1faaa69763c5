// The wind over the ground: values of cells by Fourier sums over time, the swirl by the paper's own formula, the tables that steps look up
// against the direct evaluation, what repeats against itself a period on.
#include "lib/laws/wind.h"
#include "tests/support/wind_at.h"
#include <catch2/catch.hpp>
#include <complex>
#include <numbers>
#include <random>

using namespace bough;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

Wind uniform(const Vec3& velocity) {
    Wind wind;
    wind.velocity = velocity;
    wind.profile = 0;
    return wind;
}

// 3 x 2 cells of 4 m, each its own velocity and phase.
Wind gridded() {
    Wind wind = uniform({5, 0, 1});
    WindGrid grid;
    grid.x = -3;
    grid.z = 2;
    grid.cell = 4;
    grid.columns = 3;
    grid.rows = 2;
    for (int k = 0; k < 6; ++k) {
        grid.velocity.push_back(Vec3(1 + k, 0.1 * k, -k));
        grid.phase.push_back(0.7 * k);
        grid.persistence.push_back(0.1 * k);
        grid.octaves.push_back(k);
    }
    grid.phase.erase(grid.phase.begin());
    grid.persistence.erase(grid.persistence.begin());
    grid.octaves.erase(grid.octaves.begin());
    grid.frequency = 0.25;
    wind.grid = grid;
    return wind;
}

// The middle of a cell of gridded().
Vec3 middle(int column, int row) {
    return {-3 + 4 * (column + 0.5), 7, 2 + 4 * (row + 0.5)};
}

Wind swirling(std::optional<double> wavelength = std::nullopt) {
    Wind wind = uniform({6, 0, -2});
    wind.swirl.emplace();
    wind.swirl->x = 1;
    wind.swirl->z = -2;
    wind.swirl->radius = {0, 4, 9};
    wind.swirl->angle = {0, 30, 10};
    wind.swirl->period = 3;
    wind.swirl->wavelength = wavelength;
    return wind;
}

// What the paper does to v with an angle's tangent for h over |v|.
Vec3 papers(const Vec3& v, double angle) {
    const Vec3 s = v.cross(Vec3::UnitY()).normalized(), turned = v + v.norm() * std::tan(angle) * s;
    return turned * (v.norm() / turned.norm());
}

// Everything at once.
Wind every_field() {
    Wind wind = gridded();
    wind.swirl = swirling(5).swirl;
    wind.profile = 0.2;
    wind.turbulence = 0.2;
    wind.gust_factor = 1.5;
    return wind;
}

// Component of frequency n / (samples dt) of a scalar over whole periods.
template <class F> std::complex<double> harmonic(F&& value, int n, double period) {
    constexpr int samples = 512;
    std::complex<double> sum = 0;
    for (int k = 0; k < samples; ++k) sum += value(period * k / samples) * std::polar(1.0, -two_pi * n * k / samples);
    return sum / double(samples);
}

} // namespace

TEST_CASE("a cell's wind is its mean and its octaves, each of its amplitude and frequency") {
    const Wind wind = gridded();
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 3; ++column) {
            const int k = 3 * row + column; // octaves, too
            const Vec3 mean(1 + k, 0.1 * k, -k);
            CAPTURE(k);
            double total = 0;
            for (int n = 0; n < k; ++n) total += std::pow(0.1 * k, n);
            for (const double x : {-1.9, 0.0, 1.9}) {
                const Vec3 place = middle(column, row) + Vec3(x, 0, -x);
                const auto factor = [&](double t) { return wind_at(wind, place, t).dot(mean) / mean.squaredNorm(); };
                CHECK((wind_at(wind, place, 1.3) - factor(1.3) * mean).norm() < 1e-13);
                CHECK(std::abs(harmonic(factor, 0, 4) - 1.0) < 1e-13);
                for (int octave = 0; octave < 6; ++octave) {
                    const std::complex<double> c = harmonic(factor, 1 << octave, 4);
                    const double expected = octave < k ? std::pow(0.1 * k, octave) / total : 0;
                    CHECK(2 * std::abs(c) == Approx(expected).margin(1e-12));
                    // sin(a + phase): -i/2 e^(i phase)
                    if (octave == 0 && k > 0)
                        CHECK(std::abs(std::arg(c * std::polar(1.0, 0.5 * std::numbers::pi - 0.7 * k))) < 1e-12);
                }
                CHECK(std::abs(harmonic(factor, 3, 4)) < 1e-12); // no octave
            }
        }
}

TEST_CASE("a phase is a lead in time, of all octaves") {
    Wind wind = gridded();
    wind.grid->velocity = {Vec3(3, 0, 0)};
    wind.grid->octaves = {4};
    wind.grid->persistence = {0.6};
    for (double t : {0.0, 0.7, 11.0}) {
        const double lead = 0.7 / (two_pi * 0.25); // of column 1 over column 0
        CHECK((wind_at(wind, middle(1, 0), t) - wind_at(wind, middle(0, 0), t + lead)).norm() < 1e-12);
        CHECK((wind_at(wind, middle(1, 0), t) - wind_at(wind, middle(0, 0), t)).norm() > 1e-2);
    }
}

TEST_CASE("outside the grid blows the nearest cell's wind") {
    const Wind wind = gridded();
    const std::pair<Vec3, Vec3> pairs[] = {{{-100, 7, 4}, middle(0, 0)},   {{100, 7, 4}, middle(2, 0)},
                                           {{3, 7, -50}, middle(1, 0)},    {{3, 7, 50}, middle(1, 1)},
                                           {{-1e9, 7, 1e9}, middle(0, 1)}, {{1e9, 7, 1e9}, middle(2, 1)}};
    auto table = make_wind_table<double>(wind, 10);
    evaluate_wind(wind, 2.2, table);
    for (const auto& [outside, inside] : pairs) {
        CHECK(wind_at(wind, outside, 2.2) == wind_at(wind, inside, 2.2));
        CHECK(table.at(outside) == table.at(inside));
    }
}

TEST_CASE("the grid's gusts and turbulence are the wind's as a whole") {
    Wind wind = gridded();
    wind.grid->octaves = {0};
    wind.gust_factor = 1.6;
    wind.turbulence = 0.3;
    Wind gusts = uniform(wind.velocity), rough = gusts;
    gusts.gust_factor = 1.6;
    rough.turbulence = 0.3;
    for (double t : {0.0, 1.7, 40.0}) {
        const double gust = wind_velocity(gusts, t).norm() / wind.velocity.norm();
        const Vec3 eddies = wind_velocity(rough, t) - wind.velocity;
        CHECK((wind_at(wind, middle(2, 1), t) - (gust * Vec3(6, 0.5, -5) + eddies)).norm() < 1e-12);
    }
}

TEST_CASE("one cell without octaves is the wind without a grid") {
    Wind plain = uniform({6, 0.5, -2});
    plain.profile = 0.15;
    plain.turbulence = 0.2;
    plain.gust_factor = 1.5;
    Wind one = plain;
    one.grid.emplace();
    one.grid->cell = 10;
    one.grid->columns = one.grid->rows = 1;
    auto table = make_wind_table<double>(one, 12), expected = make_wind_table<double>(plain, 12);
    CHECK(table.velocity.empty());
    for (double t : {0.0, 0.9, 33.0}) {
        evaluate_wind(one, t, table);
        evaluate_wind(plain, t, expected);
        for (const Vec3& place : {Vec3(0, 1, 0), Vec3(-70, 5.3, 20), Vec3(3, 40, 3)}) {
            CHECK((wind_at(one, place, t) - wind_at(plain, place, t)).norm() < 1e-13);
            CHECK((table.at(place) - expected.at(place)).norm() < 1e-13);
        }
    }
}

TEST_CASE("the swirl turns the wind as the paper does, on cylinders, and keeps its magnitude") {
    for (const std::optional<double> wavelength : {std::optional<double>(), std::optional<double>(5)}) {
        const Wind wind = swirling(wavelength);
        const double largest[] = {0, 30, 10}, radius[] = {0, 4, 9};
        for (int key = 0; key < 3; ++key)
            for (double around : {0.3, 2.0, 5.1})
                for (double t : {0.0, 0.4, 1.1, 2.9, 301.1}) {
                    const double r = radius[key];
                    const Vec3 place(1 + r * std::cos(around), 3, -2 + r * std::sin(around));
                    const double a = largest[key] * std::numbers::pi / 180 *
                                     std::sin(two_pi * (t / 3 - (wavelength ? r / *wavelength : 0)));
                    const Vec3 v = wind_at(wind, place, t);
                    CAPTURE(key, around, t);
                    CHECK((v - papers(wind.velocity, a)).norm() < 1e-11);
                    CHECK(v.norm() == Approx(wind.velocity.norm()).epsilon(1e-14));
                }
    }
}

TEST_CASE("a wind that rises is turned as the paper does; one straight up stays") {
    Wind wind = swirling();
    wind.velocity = Vec3(3, 2, -1);
    const Vec3 place(1 + 4, 0, -2);
    CHECK((wind_at(wind, place, 0.75) - papers(wind.velocity, std::numbers::pi / 6)).norm() < 1e-12);
    for (double y : {5.0, -5.0, 0.0}) {
        wind.velocity = Vec3(0, y, 0);
        CHECK(wind_at(wind, place, 0.75) == wind.velocity);
        auto table = make_wind_table<double>(wind, 1, 10);
        evaluate_wind(wind, 0.75, table);
        CHECK(table.at(place) == wind.velocity);
    }
}

TEST_CASE("between its keys the swirl's angle is a cubic of continuous slope, which swings past none") {
    const Wind wind = swirling();
    const auto angle = [&](double r) { // [deg] at the crest
        const Vec3 v = wind_at(wind, Vec3(1 + r, 0, -2), 0.75);
        return std::atan2(v.z() * 6 + v.x() * 2, v.x() * 6 - v.z() * 2) * 180 / std::numbers::pi;
    };
    // Slopes 0 at both ends and at the top: Hermite's cubic, w^2 (3 - 2 w).
    for (double w : {0.1, 0.25, 0.5, 0.8}) {
        CHECK(angle(4 * w) == Approx(30 * w * w * (3 - 2 * w)).epsilon(1e-12));
        CHECK(angle(4 + 5 * w) == Approx(30 - 20 * w * w * (3 - 2 * w)).epsilon(1e-12));
    }
    CHECK(angle(50) == Approx(10).epsilon(1e-12));
    Wind rising = wind;
    rising.swirl->angle = {0, 10, 40};
    const auto slope = [&](double r) {
        const auto at = [&](double x) {
            const Vec3 v = wind_at(rising, Vec3(1 + x, 0, -2), 0.75);
            return std::atan2(v.z() * 6 + v.x() * 2, v.x() * 6 - v.z() * 2) * 180 / std::numbers::pi;
        };
        return (at(r + 1e-6) - at(r - 1e-6)) / 2e-6;
    };
    const double a = 10.0 / 4, b = 30.0 / 5;
    CHECK(slope(4) == Approx(2 * a * b / (a + b)).epsilon(1e-6));
}

TEST_CASE("the tables are the field: cells exactly, turns to their own error, and the magnitude") {
    const Wind wind = every_field();
    const double top = 12, reach = 40;
    auto table = make_wind_table<double>(wind, top, reach);
    auto single = make_wind_table<float>(wind, top, reach);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(0, 1);
    for (int k = 0; k < 500; ++k) {
        const double t = 100 * any(random);
        const Vec3 place(50 * any(random) - 25, 3 + 8.5 * any(random), 50 * any(random) - 25);
        evaluate_wind(wind, t, table);
        evaluate_wind(wind, t, single);
        const Vec3 direct = wind_at(wind, place, t);
        // Of the angle: (r apart)^2 / 8 times the second derivative, mostly A (2 pi / wavelength)^2; 30 degrees, 64 entries a wavelength.
        const double apart = 1.0 / table.field.shape.rings_per_metre,
                     bound = apart * apart / 8 * 0.6 * std::pow(two_pi / 5 + 0.5, 2);
        CAPTURE(t, place.transpose());
        CHECK((table.at(place) - direct).norm() <
              (bound + 2e-4) * direct.norm() + 1e-12); // 2e-4: of the profile, at 65 heights
        CHECK(table.field.at(place.x(), place.z()).norm() ==
              Approx(wind_at(wind, place, t).norm() / wind_profile(wind, place.y())).epsilon(1e-12));
        CHECK((single.at(Vector3<float>(place.cast<float>())).cast<double>() - table.at(place)).norm() <
              2e-5 * direct.norm());
    }
    const double none = std::numeric_limits<double>::quiet_NaN(); // a run that diverges
    CHECK(table.at(Vec3(none, none, none)).allFinite());
}

TEST_CASE("the same seed makes the same octaves, another one others") {
    Wind wind = gridded(), other = wind;
    other.seed = 2;
    for (double t : {0.3, 5.0}) {
        CHECK(wind_at(wind, middle(2, 1), t) == wind_at(gridded(), middle(2, 1), t));
        CHECK((wind_at(wind, middle(2, 1), t) - wind_at(other, middle(2, 1), t)).norm() > 1e-3);
        // The first octave's phase is the scene's.
        CHECK(wind_at(wind, middle(1, 0), t) == wind_at(other, middle(1, 0), t));
    }
}

TEST_CASE("a wind with a period repeats, all of it, and keeps its mean and spread") {
    Wind wind = every_field(), free = wind;
    wind.period = 17;
    double apart = 0;
    for (double t : {0.0, 0.37, 5.0, 16.9}) {
        const Vec3 place = middle(2, 1);
        CHECK((wind_at(wind, place, t + 17) - wind_at(wind, place, t)).norm() < 1e-11);
        CHECK((wind_at(wind, place, t + 1700) - wind_at(wind, place, t)).norm() < 1e-9);
        apart = std::max(apart, (wind_at(free, place, t + 17) - wind_at(free, place, t)).norm());
    }
    CHECK(apart > 0.1);
    // The turbulence alone: waves of different whole numbers are at right angles over the period.
    for (double period : {17.0, 300.0}) {
        Wind rough = uniform({10, 0, 0});
        rough.turbulence = 0.2;
        rough.period = period;
        const int n = 1 << 14;
        Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
        for (int k = 0; k < n; ++k) {
            const Vec3 v = wind_velocity(rough, period * k / n) - rough.velocity;
            mean += v / n;
            square += v.cwiseProduct(v) / n;
        }
        CAPTURE(period);
        CHECK(mean.norm() < 1e-10);
        CHECK((square.cwiseSqrt() - 2 * Vec3(1, 0.5, 0.75)).norm() < 1e-10);
    }
    // Nearest whole numbers: a gust of 6 s goes three times into 17 s.
    Wind gusts = uniform({10, 0, 0});
    gusts.gust_factor = 1.5;
    gusts.period = 17;
    CHECK((wind_velocity(gusts, 17.0 / 3) - wind_velocity(gusts, 0)).norm() < 1e-12);
    gusts.period = 1; // less than one: one
    CHECK((wind_velocity(gusts, 0.5) - wind_velocity(gusts, 0)).norm() > 1);
    CHECK((wind_velocity(gusts, 1) - wind_velocity(gusts, 0)).norm() < 1e-12);
}

TEST_CASE("steady is what blows the same at all times") {
    Wind wind = uniform({1, 0, 0});
    CHECK(steady(wind));
    wind.grid = gridded().grid;
    CHECK_FALSE(steady(wind));
    wind.grid->octaves = {0};
    CHECK(steady(wind));
    wind.swirl = swirling().swirl;
    CHECK_FALSE(steady(wind));
    wind.swirl->angle = {0, 0, 0};
    CHECK(steady(wind));
    wind.turbulence = 0.1;
    CHECK_FALSE(steady(wind));
}

TEST_CASE("a swirl finer than a table can hold is refused") {
    const Wind wind = swirling(1e-6);
    CHECK_THROWS_WITH(make_wind_table<float>(wind, 10, 50),
                      Catch::Contains("wind/swirl") && Catch::Contains("4194304"));
}
