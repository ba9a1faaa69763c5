#include "lib/growth/grow.h"
#include "lib/growth/pipe.h"
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
    thicken_by_pipe_model(s);
    CHECK(s.radius[0] == Approx(std::sqrt(1e-6 + 9e-6 + 16e-6 + 144e-6)));
    CHECK(s.radius[1] == Approx(std::sqrt(1e-6 + 144e-6)));
    CHECK(s.radius[2] == 0.001);
    CHECK(s.radius[7] == 0.012); // nothing grows on the twigs: unchanged
}

TEST_CASE("No point of a grown tree is thinner than what grows beyond it") {
    const Splines s = grow(default_growth(), 4, false, false);
    for (std::size_t b = 0; b < s.branches(); ++b) {
        double sum = 0;
        for (std::size_t c = 0; c < s.branches(); ++c)
            if (s.parent[c] == std::int32_t(b)) sum += std::pow(s.radius[std::size_t(s.first_point[c])], 2);
        REQUIRE(std::pow(s.radius[std::size_t(s.first_point[b])], 2) >= sum * (1 - 1e-12));
    }
}
