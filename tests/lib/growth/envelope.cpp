// envelope.h: closed forms and meshes of the same shape, uniform points, volumes.
#include "lib/growth/envelope.h"
#include "lib/growth/colonize.h"
#include "tests/support/solids.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;

namespace {

Envelope shaped(EnvelopeShape shape, const Vec3& size, const Vec3& base) {
    Envelope e;
    e.shape = shape, e.size = size, e.base = base;
    return e;
}

Envelope mesh_of(const solids::Solid& s) {
    Envelope e;
    e.shape = EnvelopeShape::mesh;
    e.mesh = std::make_shared<MeshInterior>(s.vertex, s.triangle);
    return e;
}

} // namespace

TEST_CASE("Volumes by the formulas, of meshes within a few parts in a thousand") {
    const Vec3 size(2, 5, 3), base(1, 4, -2);
    CHECK(volume(shaped(EnvelopeShape::box, size, base)) == Approx(30));
    CHECK(volume(shaped(EnvelopeShape::sphere, size, base)) == Approx(4 * std::numbers::pi / 3 * 1 * 2.5 * 1.5));
    CHECK(volume(shaped(EnvelopeShape::cone, size, base)) == Approx(std::numbers::pi * 1 * 1.5 * 5 / 3));
    CHECK(volume(mesh_of(solids::l_prism())) == Approx(32).epsilon(0.01));
    const auto ball = mesh_of(solids::icosphere(4));
    CHECK(volume(ball) == Approx(ball.mesh->closure().volume).epsilon(0.01));
}

TEST_CASE("Points are inside and uniform: means and shares per part by the shape's own integrals") {
    const Vec3 size(2, 5, 3), base(1, 4, -2);
    constexpr int n = 40000;
    for (const EnvelopeShape shape : {EnvelopeShape::box, EnvelopeShape::sphere, EnvelopeShape::cone}) {
        const Envelope e = shaped(shape, size, base);
        Vec3 mean = Vec3::Zero();
        int octant[8] = {}, lower = 0;
        const Vec3 middle = base + Vec3(0, size.y() / 2, 0);
        for (std::uint64_t i = 0; i < n; ++i) {
            const Vec3 p = point_inside(e, 7, i);
            REQUIRE(contains(e, p + 1e-9 * (middle - p)));
            mean += p / n;
            ++octant[(p.x() > middle.x()) + 2 * (p.y() > middle.y()) + 4 * (p.z() > middle.z())];
            lower += p.y() <= middle.y();
        }
        const double centre = shape == EnvelopeShape::cone ? 0.25 : 0.5;
        CHECK((mean - base - Vec3(0, centre * size.y(), 0)).norm() < 0.03);
        // Five standard deviations of a binomial share.
        const double half = shape == EnvelopeShape::cone ? 7.0 / 8 : 0.5;
        CHECK(lower == Approx(half * n).margin(5 * std::sqrt(n / 4.0)));
        for (int k = 0; k < 8; ++k) {
            const double share = (k & 2 ? 1 - half : half) / 4;
            CHECK(octant[k] == Approx(share * n).margin(5 * std::sqrt(share * n)));
        }
    }
}

TEST_CASE("Points of a mesh lie in it alone, evenly over its two arms") {
    const Envelope e = mesh_of(solids::l_prism());
    constexpr int n = 20000;
    int foot = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const Vec3 p = point_inside(e, 7, i);
        REQUIRE(solids::in_l(p));
        foot += p.y() < 4;
    }
    CHECK(foot == Approx(n / 2).margin(5 * std::sqrt(n / 4.0)));
}

TEST_CASE("A sphere in closed form and as a mesh hold the same points") {
    const Envelope form = shaped(EnvelopeShape::sphere, {2, 2, 2}, {0, -1, 0}), mesh = mesh_of(solids::icosphere(5));
    int differ = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const Vec3 p = point_inside(shaped(EnvelopeShape::box, {2.2, 2.2, 2.2}, {0, -1.1, 0}), 7, i);
        differ += contains(form, p) != contains(mesh, p);
    }
    CHECK(differ <= 20); // the shell between them is 0.06 % of the sphere
    CHECK((lower_corner(form) - lower_corner(mesh)).norm() < 0.01);
    CHECK((upper_corner(form) - upper_corner(mesh)).norm() < 0.01);
}

TEST_CASE("An envelope without a volume is refused") {
    CHECK_THROWS_WITH(check_envelope(shaped(EnvelopeShape::box, {1, 0, 1}, Vec3::Zero())),
                      Catch::Contains("above 0 m"));
    CHECK_THROWS_WITH(check_envelope(shaped(EnvelopeShape::mesh, {1, 1, 1}, Vec3::Zero())), Catch::Contains("no mesh"));
    const solids::Solid flat{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)}, {{0, 1, 2}}};
    CHECK(volume(mesh_of(flat)) == 0);
    CHECK_THROWS_WITH(point_inside(mesh_of(flat), 7, 0), Catch::Contains("none of 1e6"));
}

TEST_CASE("A volume that is known is not measured again") {
    Envelope e = mesh_of(solids::icosphere(3));
    ColonizeParameters p;
    p.envelope = e;
    p.points = 1000;
    const double kill = with_defaults(p).kill;
    CHECK(kill == 0.8 * std::cbrt(volume(e) / 1000));
    p.envelope.space = 8 * volume(e); // as no measurement would find it
    CHECK(volume(p.envelope) == 8 * volume(e));
    CHECK(with_defaults(p).kill == Approx(2 * kill).epsilon(1e-14));
}
