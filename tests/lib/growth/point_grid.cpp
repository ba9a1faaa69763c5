// point_grid.h: against looking at every point.
#include "lib/growth/point_grid.h"
#include "lib/growth/random.h"
#include <algorithm>
#include <catch2/catch.hpp>

using namespace bough;

TEST_CASE("The grid finds what brute force finds, while points are taken out") {
    enum class Draw : std::uint8_t { x, y, z, query, take };
    const auto place = [](std::uint64_t i, std::uint64_t what) {
        const RandomKey key = random_key(RandomKey{what}, Draw::query, i);
        return Vec3(random_unit(key, Draw::x), 3 * random_unit(key, Draw::y) - 1, 0.2 * random_unit(key, Draw::z));
    };
    for (const double cell : {1e-4, 0.07, 10.0}) {
        std::vector<Vec3> points;
        for (std::uint64_t i = 0; i < 3000; ++i) points.push_back(place(i, 1));
        points.push_back(points[0]); // two at one place
        PointGrid grid(points, cell);
        std::vector<bool> left(points.size(), true);
        for (std::uint64_t q = 0; q < 300; ++q) {
            const Vec3 p = 1.4 * place(q, 2);
            const double radius = q % 3 == 0 ? 0.02 : q % 3 == 1 ? 0.2 : 4;
            std::vector<std::int32_t> found, expected;
            grid.each_nearer(p, radius, [&](std::int32_t i, double square) {
                CHECK(square == (points[static_cast<std::size_t>(i)] - p).squaredNorm());
                if (square <= radius * radius) found.push_back(i);
                return double(INFINITY);
            });
            for (std::size_t i = 0; i < points.size(); ++i)
                if (left[i] && (points[i] - p).squaredNorm() <= radius * radius)
                    expected.push_back(static_cast<std::int32_t>(i));
            std::sort(found.begin(), found.end());
            REQUIRE(found == expected);
            for (std::size_t k = 0; k < 9; ++k) {
                const std::size_t out = (q * 9 + k) * 7 % points.size();
                if (!left[out]) continue;
                left[out] = false;
                grid.remove(static_cast<std::int32_t>(out));
            }
        }
    }
}

TEST_CASE("Places named one after another: the nearest of each point is brute force's") {
    enum class Draw : std::uint8_t { x, y, z };
    const auto place = [](RandomKey key, std::uint64_t i) {
        return Vec3(random_unit(key, Draw::x, i), random_unit(key, Draw::y, i), random_unit(key, Draw::z, i));
    };
    for (const double radius : {0.15, 0.6, 3.0}) {
        std::vector<Vec3> points;
        for (std::uint64_t i = 0; i < 2000; ++i) points.push_back(place(1, i));
        PointGrid grid(points, 0.1);
        std::vector<double> least(points.size(), INFINITY), expected = least;
        std::size_t calls = 0;
        for (std::uint64_t q = 0; q < 500; ++q) {
            const Vec3 p = place(2, q);
            grid.each_nearer(p, radius, [&](std::int32_t i, double square) {
                ++calls;
                double& now = least[static_cast<std::size_t>(i)];
                if (square <= radius * radius) now = std::min(now, square);
                return now;
            });
            for (std::size_t i = 0; i < points.size(); ++i)
                if (const double square = (points[i] - p).squaredNorm(); square <= radius * radius)
                    expected[i] = std::min(expected[i], square);
            REQUIRE(least == expected);
        }
        CHECK(calls < 500 * points.size() / 10);
    }
}

TEST_CASE("A grid of no points finds none") {
    PointGrid grid({}, 1);
    grid.each_nearer(Vec3::Zero(), 1e9, [](std::int32_t, double) {
        FAIL("found a point");
        return 0.0;
    });
}
