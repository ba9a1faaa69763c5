// The nearest point of a polyline, found in boxes, beside what looking at each segment finds.
#include "formats/imports/polyline_search.h"
#include "tests/support/sanitized.h"
#include <catch2/catch.hpp>
#include <random>

using namespace bough;

namespace {

void same(const OnPolyline& a, const OnPolyline& b) {
    CHECK(a.segment == b.segment);
    CHECK(a.t == b.t);
    CHECK(a.distance == b.distance);
    CHECK(a.fraction == b.fraction);
}

} // namespace

TEST_CASE("boxes find what looking at each segment finds, bit by bit") {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    const auto any = [&](double size) {
        return Vec3(size * normal(engine), size * normal(engine), size * normal(engine));
    };
    for (const std::size_t points : cases<std::size_t>(9, {1, 2, 3, 8, 9, 10, 64, 65, 66, 600, 5000})) {
        INFO(points);
        std::vector<Vec3> walk{any(1)}, straight,
            back; // a random walk; even steps with ties; there and back again over the same points
        for (std::size_t k = 1; k < points; ++k) walk.push_back(walk.back() + any(0.1));
        for (std::size_t k = 0; k < points; ++k) straight.emplace_back(0, double(k), 0);
        for (std::size_t k = 0; k < points; ++k) back.emplace_back(0, double(k < points / 2 ? k : points - k), 0);
        for (const std::vector<Vec3>* polyline : {&walk, &straight, &back}) {
            const PolylineSearch search(*polyline);
            for (int k = 0; k < 200; ++k) {
                const Vec3 p = k % 4 == 0   ? (*polyline)[engine() % points] // on a point, which two segments have
                               : k % 4 == 1 ? Vec3(1, double(engine() % points) + 0.5 * double(k % 2), 0)
                                            : any(k % 4 == 2 ? 2 : 1000);
                same(search.nearest(p), nearest_on(*polyline, p));
            }
        }
    }
}

TEST_CASE("of branches, long and short") {
    std::vector<ImportedBranch> branches(2);
    for (int k = 0; k < 1000; ++k) branches[0].point.emplace_back(0, 0.01 * k, 0);
    for (int k = 0; k < 5; ++k) branches[1].point.emplace_back(0.1 * k, 3, 0);
    BranchSearch search(branches);
    for (const Vec3& p : {Vec3(0.2, 3.333, 0), Vec3(9, 9, 9), Vec3(-1, 0, 0)})
        for (const std::size_t b : {0, 1, 0}) same(search.nearest(b, p), nearest_on(branches[b].point, p));
}

// What is far from the point asked for is moved onto it once the boxes are made: who looks at it finds it nearer. (Of segments; how many boxes are asked
// is not seen.)
TEST_CASE("asking a long branch looks at what is near alone") {
    const std::size_t points = 200000, window = 64;
    for (const std::size_t at : {std::size_t(100), points / 3, points - 100}) {
        std::vector<ImportedBranch> branches(1);
        for (std::size_t k = 0; k < points; ++k) branches[0].point.emplace_back(0, 10.0 * double(k) / points, 0);
        BranchSearch search(branches);
        const Vec3 p(1e-4, branches[0].point[at].y(), 0);
        const OnPolyline before = search.nearest(0, p);
        CHECK(before.distance == Approx(1e-4));
        for (std::size_t k = 0; k < points; ++k)
            if (k + window < at || k > at + window) branches[0].point[k] = p;
        const OnPolyline after = search.nearest(0, p);
        CHECK(after.segment == before.segment);
        CHECK(after.t == before.t);
        CHECK(after.distance == before.distance);
    }
}
