// How long work takes is told once, after its first two seconds, where more than a minute is left.
#include "tools/long_run.h"
#include <catch2/catch.hpp>
#include <vector>

using namespace bough;

namespace {

// What is told of `total` pieces of `each` seconds.
std::vector<double> told(std::int64_t total, double each) {
    std::vector<double> lines;
    double now = 1000;
    LongRun run(
        total, [&](double left) { lines.push_back(left); }, [&] { return now; });
    for (std::int64_t k = 1; k <= total; ++k) {
        now += each;
        run.at(k);
    }
    return lines;
}

} // namespace

TEST_CASE("a minute and more is told beforehand, once") {
    const std::vector<double> lines = told(1000, 0.5);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0] == Approx(0.5 * (1000 - 4)));
    CHECK(told(100, 3) == std::vector<double>{3.0 * 99}); // the first piece alone takes longer than is waited for
}

TEST_CASE("what ends within a minute is not told of") {
    CHECK(told(124, 0.5).empty()); // 60 s after the fourth
    CHECK(told(125, 0.5).size() == 1);
    CHECK(told(10, 0.1).empty());
    CHECK(told(0, 1).empty());
}
