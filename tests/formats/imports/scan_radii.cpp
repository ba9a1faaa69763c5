// Thin branches of a scan (scan_radii.h): what is left thick, and a tree whose bound is counted by hand, twig by twig.
#include "formats/imports/scan_radii.h"
#include "tests/support/import_support.h"
#include <cmath>

using namespace bough;
using namespace bough::test;

namespace {

void add_branch(Splines& s, std::int32_t parent, double at, std::vector<Vec3> points, std::vector<double> radius) {
    s.parent.push_back(parent);
    s.parent_at.push_back(at);
    s.level.push_back(parent < 0 ? 0 : s.level[std::size_t(parent)] + 1);
    if (s.first_point.empty()) s.first_point.push_back(0);
    s.point.insert(s.point.end(), points.begin(), points.end());
    s.radius.insert(s.radius.end(), radius.begin(), radius.end());
    s.first_point.push_back(std::int32_t(s.point.size()));
}

// [m] of wood beyond point k of branch b, by going through all of them.
double beyond(const Splines& s, std::size_t b, std::size_t k) {
    const auto point = [&](std::size_t i) { return s.point[std::size_t(s.first_point[b]) + i]; };
    const std::size_t n = std::size_t(s.first_point[b + 1] - s.first_point[b]);
    double whole = 0, here = 0;
    for (std::size_t i = 1; i < n; ++i) {
        whole += (point(i) - point(i - 1)).norm();
        if (i == k) here = whole;
    }
    double sum = whole - here;
    for (std::size_t c = 0; c < s.branches(); ++c)
        if (s.parent[c] == std::int32_t(b) && s.parent_at[c] * whole >= here) sum += beyond(s, c, 0);
    return sum;
}

} // namespace

TEST_CASE("what a scan sees stays, what it does not is bounded by the wood beyond") {
    Splines s;
    // A trunk, seen up to 6 m; a bough, seen at its foot; a twig on the bough; a twig on the trunk's thin end.
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 3, 0}, {0, 6, 0}, {0, 8, 0}}, {0.2, 0.1, 0.04, 0.02});
    add_branch(s, 0, 0.375, {{0, 3, 0}, {1, 3, 0}, {3, 3, 0}}, {0.05, 0.024, 0.03});
    add_branch(s, 1, 1.0 / 3, {{1, 3, 0}, {1, 3.25, 0}}, {0.02, 0.001});
    add_branch(s, 0, 0.875, {{0, 7, 0}, {1, 7, 0}}, {0.02, 0.02});
    const Splines drawn = s;
    ImportNotes notes;
    bound_scan_radii(s, notes);
    const auto share = [&](std::size_t b, std::size_t k, double R, std::size_t b0, std::size_t k0) {
        return R * std::pow(beyond(drawn, b, k) / beyond(drawn, b0, k0), 1 / 2.25);
    };
    CHECK(beyond(drawn, 0, 0) == Approx(8 + 3 + 0.25 + 1));
    for (const std::size_t seen : {0, 1, 2, 4}) CHECK(s.radius[seen] == drawn.radius[seen]);
    CHECK(s.radius[3] == Approx(0.0015));                                   // the trunk's tip: nothing beyond
    CHECK(s.radius[5] == Approx(std::min(0.024, share(1, 1, 0.05, 1, 0)))); // 2.25 of 3.25 m
    CHECK(s.radius[6] == Approx(0.0015));                  // 30 mm thick beyond what is not seen: an error of the scan
    CHECK(s.radius[7] == Approx(share(2, 0, 0.05, 1, 0))); // 0.25 of 3.25 m
    CHECK(s.radius[8] == 0.001);                           // nothing is made thicker
    CHECK(s.radius[9] == Approx(std::min(0.02, share(3, 0, 0.04, 0, 2))));
    CHECK(s.radius[10] == Approx(0.0015));
    REQUIRE(notes.lines.size() == 1);
    CHECK(notes.lines[0].starts_with("--scan-radii: 4 of 11 radii"));
}

TEST_CASE("a tree that is thin throughout is bounded from its foot") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}, {0.01, 0.01, 0.01});
    ImportNotes notes;
    bound_scan_radii(s, notes);
    CHECK(s.radius[0] == 0.01);
    CHECK(s.radius[1] == Approx(0.01 * std::pow(0.5, 1 / 2.25)));
    CHECK(s.radius[2] == Approx(0.0015));
}
