// The wind's means, peaks and spreads by numerical integration over time; its table against the field itself.
#include "lib/laws/wind.h"
#include "tests/support/integrate.h"
#include <catch2/catch.hpp>
#include <limits>

using namespace bough;

namespace {

Wind steady_wind(const Vec3& velocity) {
    Wind wind;
    wind.velocity = velocity;
    return wind;
}

struct Spread {
    Vec3 mean = Vec3::Zero(), deviation = Vec3::Zero();
};

// Over hours of wind, in the given axes, at times that no frequency of the sum is commensurate with.
Spread spread(const Wind& wind, const Mat3& axes) {
    const int samples = 60000;
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    for (int k = 0; k < samples; ++k) {
        const Vec3 v = axes.transpose() * wind_velocity(wind, 0.73205080757 * k);
        sum += v;
        squares += v.cwiseProduct(v);
    }
    Spread s;
    s.mean = sum / samples;
    s.deviation = (squares / samples - s.mean.cwiseProduct(s.mean)).cwiseSqrt();
    return s;
}

} // namespace

TEST_CASE("a steady_wind wind is its velocity, blowing toward it, at all times") {
    const Wind wind = steady_wind({3, 0, -4});
    for (double t : {0.0, 1.3, 1e5}) CHECK(wind_velocity(wind, t) == Vec3(3, 0, -4));
    CHECK(wind_velocity(steady_wind(Vec3::Zero()), 1) == Vec3::Zero());
}

TEST_CASE("gusts have mean 0 and peak 1, one crest a period") {
    Wind wind = steady_wind({4, 0, 0});
    wind.gust_factor = 1.7;
    wind.gust_period = 6;
    const auto gust = [&](double t) { return (wind_velocity(wind, t).x() / 4 - 1) / 0.7; };
    CHECK(std::abs(integrate(gust, 0, 6) / 6) < 1e-13);
    CHECK(gust(0) == Approx(1).epsilon(1e-13));
    CHECK(gust(12) == Approx(1).epsilon(1e-13));
    int crests = 0;
    for (int k = 0; k < 6000; ++k) {
        const double t = 0.001 * k + 0.0005, here = gust(t);
        CHECK(here <= 1);
        CHECK(here >= -0.5);
        crests += here > gust(t - 0.001) && here >= gust(t + 0.001);
        CHECK(gust(t + 18) == Approx(here).margin(1e-11));
    }
    CHECK(crests == 1);
    CHECK(wind_velocity(wind, 0).norm() == Approx(4 * 1.7).epsilon(1e-13));
}

TEST_CASE("turbulence has the stated spread along, across and up, and mean 0") {
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0.6, 0, -0.8)})
        for (std::uint64_t seed : {1u, 2u, 99u}) {
            Wind wind = steady_wind(10 * direction);
            wind.turbulence = 0.2;
            wind.seed = seed;
            const Vec3 up = Vec3::UnitY();
            Mat3 axes;
            axes << direction, up.cross(direction), up;
            const Spread s = spread(wind, axes);
            CAPTURE(seed);
            CHECK((s.mean - Vec3(10, 0, 0)).norm() < 0.05);
            CHECK(s.deviation[0] == Approx(2.0).epsilon(0.1));
            CHECK(s.deviation[1] == Approx(1.5).epsilon(0.1));
            CHECK(s.deviation[2] == Approx(1.0).epsilon(0.1));
        }
}

TEST_CASE("a wind straight up has turbulence too") {
    Wind wind = steady_wind({0, 5, 0});
    wind.turbulence = 0.2;
    Mat3 axes;
    axes << Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ();
    const Spread s = spread(wind, axes);
    CHECK(s.deviation[0] == Approx(1.0).epsilon(0.1));
    CHECK(s.deviation[1] == Approx(0.75).epsilon(0.1));
    CHECK(s.deviation[2] == Approx(0.5).epsilon(0.1));
}

TEST_CASE("the seed makes the turbulence and nothing else does") {
    Wind wind = steady_wind({10, 0, 0});
    wind.turbulence = 0.2;
    Wind same = wind, other = wind;
    other.seed = 2;
    for (double t : {0.0, 0.5, 77.0}) {
        CHECK(wind_velocity(wind, t) == wind_velocity(same, t));
        CHECK((wind_velocity(wind, t) - wind_velocity(other, t)).norm() > 1e-3);
    }
    other.turbulence = wind.turbulence = 0;
    CHECK(wind_velocity(wind, 3) == wind_velocity(other, 3));
}

TEST_CASE("the profile is a power of the height") {
    Wind wind = steady_wind({1, 0, 0});
    wind.profile = 0.5;
    wind.reference_height = 4;
    CHECK(wind_profile(wind, 4) == 1);
    CHECK(wind_profile(wind, 1) == Approx(0.5).epsilon(1e-15));
    CHECK(wind_profile(wind, 16) == Approx(2).epsilon(1e-15));
    CHECK(wind_profile(wind, 0) == 0);
    CHECK(wind_profile(wind, -3) == 0);
    wind.profile = 0;
    CHECK(wind_profile(wind, -3) == 1);
}

TEST_CASE("the table is the field at its entries, linear between, constant above") {
    Wind wind = steady_wind({6, 0, 2});
    wind.turbulence = 0.2;
    wind.gust_factor = 1.5;
    const double top = 16, t = 2.7;
    auto table = make_wind_table<double>(wind, top);
    auto single = make_wind_table<float>(wind, top);
    evaluate_wind(wind, t, table);
    evaluate_wind(wind, t, single);
    REQUIRE(table.velocity.size() == 65);
    const auto field = [&](double y) { return Vec3(wind_profile(wind, y) * wind_velocity(wind, t)); };
    const double cell = top / 64;
    for (int k = 0; k <= 64; ++k) {
        CAPTURE(k);
        CHECK((table.at(k * cell) - field(k * cell)).norm() < 1e-12);
        if (k == 64) continue;
        CHECK((table.at((k + 0.3) * cell) - (0.7 * field(k * cell) + 0.3 * field((k + 1) * cell))).norm() < 1e-12);
        CHECK((single.at(float((k + 0.3) * cell)).cast<double>() - table.at((k + 0.3) * cell)).norm() < 1e-4);
        // Linear interpolation's error, cell^2 |u''| / 8 at the cell's lower end.
        const double curvature = k == 0 ? 1e9 : 0.15 * 0.85 * field(k * cell).norm() / (k * k) / 8;
        CHECK((table.at((k + 0.5) * cell) - field((k + 0.5) * cell)).norm() <= curvature);
    }
    CHECK(table.at(-5) == Vec3::Zero());
    CHECK(table.at(100) == table.velocity.back());
    CHECK(table.at(std::numeric_limits<double>::quiet_NaN()) == table.velocity.front()); // a run that diverges
}

TEST_CASE("a uniform wind's table is one entry, the same everywhere") {
    Wind wind = steady_wind({6, 0, 2});
    wind.profile = 0;
    for (double top : {0.0, 10.0}) {
        auto table = make_wind_table<double>(wind, top);
        evaluate_wind(wind, 0, table);
        CHECK(table.velocity.size() == 1);
        for (double y : {-1.0, 0.0, 3.0, 1e9}) CHECK(table.at(y) == Vec3(6, 0, 2));
    }
}

TEST_CASE("presets have the mean speeds that their names promise, along +x") {
    const std::pair<const char*, double> expected[] = {{"calm", 1}, {"breeze", 4}, {"gusty", 8}, {"storm", 20}};
    for (const auto& [name, speed] : expected) {
        const auto wind = wind_preset(name);
        REQUIRE(wind.has_value());
        CAPTURE(name);
        CHECK(wind->velocity == Vec3(speed, 0, 0));
        const Spread s = spread(*wind, Mat3::Identity());
        CHECK(s.mean.x() == Approx(speed).epsilon(0.01));
        CHECK(s.mean.tail<2>().norm() < 0.01 * speed);
        CHECK(wind->gust_factor > 1);
        Scene scene;
        scene.wind = wind;
        CHECK_FALSE(check(scene).has_value());
    }
    CHECK_FALSE(wind_preset("hurricane").has_value());
}
