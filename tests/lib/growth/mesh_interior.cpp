// mesh_interior.h: inside against closed forms and against the solid angle of all triangles, on closed, concave, overlapping,
// turned, torn and hollow meshes.
#include "lib/growth/random.h"
#include "tests/support/sanitized.h"
#include "tests/support/solids.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace bough::solids;

namespace {

enum class Draw : std::uint8_t { x, y, z };

Vec3 point(std::uint64_t i, const Vec3& low, const Vec3& high) {
    const Vec3 unit(random_unit(1, Draw::x, i), random_unit(1, Draw::y, i), random_unit(1, Draw::z, i));
    return low + unit.cwiseProduct(high - low);
}

// Winding number by the solid angles of van Oosterom and Strackee: another method, O(triangles).
double winding(const Solid& s, const Vec3& p) {
    double sum = 0;
    for (const auto& [i, j, k] : s.triangle) {
        const Vec3 a = s.vertex[static_cast<std::size_t>(i)] - p, b = s.vertex[static_cast<std::size_t>(j)] - p,
                   c = s.vertex[static_cast<std::size_t>(k)] - p;
        const double A = a.norm(), B = b.norm(), C = c.norm();
        sum += 2 * std::atan2(a.dot(b.cross(c)), A * B * C + a.dot(b) * C + b.dot(c) * A + c.dot(a) * B);
    }
    return sum / (4 * std::numbers::pi);
}

} // namespace

TEST_CASE("A box, points on its edges' lines included") {
    const Solid s = unit_box();
    const MeshInterior inside(s.vertex, s.triangle);
    CHECK(inside.closure().open_edges == 0);
    CHECK(inside.closure().alike);
    CHECK(inside.closure().volume == Approx(1));
    CHECK(inside.closure().crossings == Approx(2));
    // A lattice whose rays meet corners, edges and diagonals.
    for (int i = -4; i <= 12; ++i)
        for (int j = -4; j <= 12; ++j)
            for (int k = -4; k <= 12; ++k) {
                const auto in = [](int n) { return n > 0 && n < 8; };
                const auto on = [](int n) { return n == 0 || n == 8; };
                if (on(i) || on(j) || on(k)) continue;
                CHECK(inside.contains(Vec3(i, j, k) / 8) == (in(i) && in(j) && in(k)));
            }
}

TEST_CASE("An L-shaped prism keeps its notch outside") {
    const Solid s = l_prism();
    const MeshInterior inside(s.vertex, s.triangle);
    CHECK(inside.closure().alike);
    CHECK(inside.closure().volume == Approx(2 * (4 * 2 + 2 * 4)));
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const Vec3 p = point(i, {-1, 1, -1}, {5, 9, 3});
        REQUIRE(inside.contains(p) == in_l(p));
    }
}

TEST_CASE("An icosphere is between its inscribed and its circumscribed sphere, and agrees with the solid angle") {
    const Solid s = icosphere(3);
    const MeshInterior inside(s.vertex, s.triangle);
    int differ = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const Vec3 p = point(i, Vec3::Constant(-1.1), Vec3::Constant(1.1));
        if (p.norm() > 1) CHECK_FALSE(inside.contains(p));
        if (p.norm() < 0.985) CHECK(inside.contains(p));
        differ += inside.contains(p) != (winding(s, p) > 0.5);
    }
    CHECK(differ == 0);
    CHECK(inside.closure().crossings == Approx(std::numbers::pi / 2).epsilon(0.01)); // two discs in a square
}

TEST_CASE("Overlapping parts unite, turned over or not; a shell that faces inward is a hollow") {
    const Solid one = icosphere(2), other = moved(icosphere(2), 1, {0.9, 0.1, 0.2});
    const Solid small = moved(icosphere(2), 0.5, Vec3::Zero());
    const Solid both = together(one, other), over = turned_over(both), hollow = together(one, turned_over(small));
    for (const Solid& s : {both, over, hollow}) {
        const MeshInterior inside(s.vertex, s.triangle);
        CHECK(inside.closure().alike);
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const Vec3 p = point(i, {-1.1, -1.2, -1.2}, {2, 1.2, 1.3});
            REQUIRE(inside.contains(p) == (std::abs(winding(s, p)) > 0.5));
        }
    }
}

TEST_CASE("Faces that face any way, and a torn mesh") {
    Solid mixed = icosphere(2);
    for (std::size_t i = 0; i < mixed.triangle.size(); i += 3) std::swap(mixed.triangle[i][0], mixed.triangle[i][1]);
    Solid torn = icosphere(3);
    torn.triangle.erase(torn.triangle.begin() + 100, torn.triangle.begin() + 110);
    const Solid whole = icosphere(3);
    const MeshInterior any(mixed.vertex, mixed.triangle), open(torn.vertex, torn.triangle);
    CHECK(any.closure().open_edges == 0);
    CHECK_FALSE(any.closure().alike);
    CHECK(open.closure().open_edges > 0);
    const Solid fine = icosphere(2);
    int differ = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const Vec3 p = point(i, Vec3::Constant(-1.1), Vec3::Constant(1.1));
        REQUIRE(any.contains(p) == (winding(fine, p) > 0.5));
        differ += open.contains(p) != (winding(whole, p) > 0.5);
    }
    CHECK(differ <= 15); // right before the hole, where most rays leave through it
}

TEST_CASE("What is no mesh is refused by name") {
    const Solid s = unit_box();
    CHECK_THROWS_WITH(MeshInterior(s.vertex, {{0, 1, 8}}),
                      Catch::Contains("names vertex 8") && Catch::Contains("0 to 7"));
    CHECK_THROWS_WITH(MeshInterior(s.vertex, {{0, 0, 1}}), Catch::Contains("no triangle has an area"));
    CHECK_THROWS_WITH(MeshInterior({Vec3(0, NAN, 0)}, {}), Catch::Contains("not finite"));
}

TEST_CASE("Corners out of order are refused, as many layers as a crown has are not") {
    const auto boxes = [](int n) {
        Solid all = unit_box();
        for (int k = 1; k < n; ++k) all = together(all, moved(unit_box(), 1, {0, 0, 0}));
        return all;
    };
    const Solid dense = boxes(49), denser = boxes(51);
    CHECK_NOTHROW(MeshInterior(dense.vertex, dense.triangle));
    CHECK_THROWS_WITH(
        MeshInterior(denser.vertex, denser.triangle),
        "a straight line through it crosses 102 of its 612 triangles on average, expected at most 100, as "
        "through the surface of a crown; are the corners of its faces in order?");
    Solid shells = icosphere(2); // as dense, but each in order: united, as they overlap
    for (int k = 1; k < 70; ++k) shells = together(shells, moved(icosphere(2), 1 - 0.001 * k, {0, 0, 0}));
    const MeshInterior united(shells.vertex, shells.triangle);
    CHECK(united.closure().crossings > MeshInterior::most_crossings);
    CHECK(united.contains({0.1, 0.2, 0.3}));
    Solid shuffled = icosphere(4);
    for (std::size_t i = 0; i < shuffled.triangle.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const double other = random_unit(1, Draw::x, 3 * i + k) * double(shuffled.vertex.size());
            shuffled.triangle[i][k] = std::int32_t(other);
        }
    CHECK_THROWS_WITH(MeshInterior(shuffled.vertex, shuffled.triangle), Catch::Contains("in order?"));
}

// Looking at all triangles for each point would take as many hours as CTest gives minutes.
TEST_CASE("A hundred thousand points in a mesh of 80000 triangles, and among long thin ones") {
    const Solid s = icosphere(6);
    Solid round; // a prism over a 10000-gon of radius 1, y 0..1, its lids fans
    constexpr int sides = 10000;
    for (int i = 0; i < sides; ++i)
        for (const double y : {0.0, 1.0}) {
            const double turn = 2 * std::numbers::pi * i / sides;
            round.vertex.emplace_back(std::cos(turn), y, std::sin(turn));
        }
    round.vertex.emplace_back(0, 0, 0);
    round.vertex.emplace_back(0, 1, 0);
    for (std::int32_t i = 0; i < sides; ++i) {
        const std::int32_t a = 2 * i, b = 2 * ((i + 1) % sides);
        round.triangle.insert(round.triangle.end(),
                              {{a, a + 1, b}, {b, a + 1, b + 1}, {a, b, 2 * sides}, {b + 1, a + 1, 2 * sides + 1}});
    }
    const MeshInterior inside(s.vertex, s.triangle), prism(round.vertex, round.triangle);
    CHECK(prism.closure().alike);
    int count = 0, wrong = 0;
    const std::uint64_t points = sanitized ? 10000 : 100000;
    for (std::uint64_t i = 0; i < points; ++i) {
        count += inside.contains(point(i, Vec3::Constant(-1), Vec3::Constant(1)));
        const Vec3 p = point(i, {-1, -0.5, -1}, {1, 1.5, 1});
        wrong += prism.contains(p) != (p.y() >= 0 && p.y() <= 1 && std::hypot(p.x(), p.z()) <= 1 - 5e-8);
    }
    CHECK(count / double(points) == Approx(std::numbers::pi / 6).margin(0.01));
    CHECK(wrong <= 1);
}
