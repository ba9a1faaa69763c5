#include "lib/growth/pipe.h"
#include "lib/growth/grow.h"
#include <catch2/catch.hpp>

using namespace bough;

TEST_CASE("A branch bears the cross-sections of its side branches") {
    // A trunk of three points with two twigs at a quarter and one at three quarters of its length.
    Splines s;
    s.parent = {-1, 0, 0, 0};
    s.parent_at = {0, 0.25, 0.25, 0.75};
    s.level = {0, 1, 1, 1};
    s.first_point = {0, 3, 5, 7, 9};
    s.point = {{0, 0, 0},   {0, 1, 0},    {0, 2, 0},   {0, 0.5, 0}, {1, 0.5, 0},
               {0, 0.5, 0}, {-1, 0.5, 0}, {0, 1.5, 0}, {0, 1.5, 1}};
    s.radius = {0.001, 0.001, 0.001, 0.003, 0.001, 0.004, 0.001, 0.012, 0.001};
    thicken_by_pipe_model(s, 2);
    // Each twig's tip counts 1e-6, each load at both points beside it.
    CHECK(s.radius[0] == Approx(std::sqrt(4e-6)));
    CHECK(s.radius[1] == Approx(std::sqrt(4e-6)));
    CHECK(s.radius[2] == Approx(std::sqrt(2e-6)));
    CHECK(s.radius[3] == 0.003); // nothing grows on the twigs: unchanged
    CHECK(s.radius[7] == 0.012);
}

TEST_CASE("A grown tree's branches are as thick as all tips beyond them together") {
    const Splines s = grow(default_growth(), 4, {});
    std::vector<double> tips(s.branches(), 0.0);
    for (std::size_t b = s.branches(); b-- > 0;) {
        const double tip = s.radius[std::size_t(s.first_point[b + 1]) - 1];
        tips[b] += 0.0005 * 0.0005; // the least radius: what a tip has at least
        REQUIRE(tip >= 0.0005);
        REQUIRE(std::pow(s.radius[std::size_t(s.first_point[b])], 2) >= tips[b] * (1 - 1e-12));
        if (s.parent[b] >= 0) tips[std::size_t(s.parent[b])] += tips[b];
    }
    REQUIRE(tips[0] > 1e-4);
}
