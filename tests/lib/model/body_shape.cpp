#include "lib/model/body_shape.h"
#include "tests/support/integrate.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using std::numbers::pi;

namespace {

// Mass, first and second moments of a body of thin slices across z: area(z), and its second moments about x and y.
template <class Area, class AboutX, class AboutY>
MassProperties sliced(double from, double to, double density, Area area, AboutX about_x, AboutY about_y) {
    MassProperties body;
    body.mass = density * integrate(area, from, to);
    const double first = density * integrate([&](double z) { return z * area(z); }, from, to);
    body.com = Vec3(0, 0, body.mass > 0 ? first / body.mass : (from + to) / 2);
    const auto z2 = [&](double z) { return (z - body.com.z()) * (z - body.com.z()) * area(z); };
    const double along = integrate(z2, from, to);
    const double xx = integrate(about_x, from, to), yy = integrate(about_y, from, to);
    body.inertia = (density * Vec3(along + xx, along + yy, xx + yy)).asDiagonal();
    return body;
}

void require_same(const MassProperties& a, const MassProperties& b, double tolerance) {
    CHECK(a.mass == Approx(b.mass).epsilon(tolerance));
    CHECK((a.com - b.com).norm() <= tolerance * b.com.norm());
    CHECK((a.inertia - b.inertia).norm() <= tolerance * b.inertia.norm());
}

} // namespace

TEST_CASE("frustum equals the sum of its discs") {
    struct {
        double length, base, tip;
    } const shapes[] = {{2, 0.3, 0.3},       {2, 0.3, 0.1},  {2, 0.1, 0.3},     {0.5, 0.2, 0},
                        {0.5, 0, 0.2},       {0.01, 1, 0.5}, {30, 0.01, 0.002}, {1, 0.1, 0.1 * (1 + 1e-12)},
                        {1, 0.1, 0.1 - 1e-9}};
    for (const auto& s : shapes) {
        CAPTURE(s.length, s.base, s.tip);
        const auto r = [&](double z) { return s.base + (s.tip - s.base) * z / s.length; };
        const auto area = [&](double z) { return pi * r(z) * r(z); };
        const auto disc = [&](double z) { return pi * std::pow(r(z), 4) / 4; };
        require_same(frustum(s.length, s.base, s.tip, 850), sliced(0, s.length, 850, area, disc, disc), 1e-11);
    }
}

TEST_CASE("frustum turned over has the same mass and inertia, its centre mirrored") {
    const MassProperties a = frustum(1.7, 0.2, 0.05, 900), b = frustum(1.7, 0.05, 0.2, 900);
    CHECK(a.mass == Approx(b.mass).epsilon(1e-14));
    CHECK(a.com.z() == Approx(1.7 - b.com.z()).epsilon(1e-14));
    CHECK((a.inertia - b.inertia).norm() <= 1e-14 * a.inertia.norm());
}

TEST_CASE("frustum without radius has no mass and finite numbers") {
    const MassProperties body = frustum(1, 0, 0, 900);
    CHECK(body.mass == 0);
    CHECK(body.com.allFinite());
    CHECK(body.inertia.norm() == 0);
}

TEST_CASE("leaf prism equals the sum of its strips") {
    const double length = 0.09, width = 0.06, thickness = 0.004;
    const auto half = [&](double z) { return width / 2 * (1 - z / length); };
    const auto area = [&](double z) { return 2 * half(z) * thickness; };
    const auto across = [&](double z) { return 2 * half(z) * std::pow(thickness, 3) / 12; };
    const auto along = [&](double z) { return thickness * std::pow(2 * half(z), 3) / 12; };
    require_same(leaf_prism(length, width, thickness, 800), sliced(0, length, 800, area, across, along), 1e-11);
}

TEST_CASE("a leaf's blade equals the sum of its strips, a clump that of its discs, each with the mass of the leaf's "
          "triangle") {
    const double length = 0.09, width = 0.06, thickness = 0.004, mass = 800 * length * width / 2 * thickness;
    // The blade: an ellipse over the outer two thirds. (Steep at its ends: the sum is less exact.)
    const double a = length / 3, from = length / 3;
    const auto half = [&](double z) {
        return width / 2 * std::sqrt(std::max(0.0, 1 - std::pow((z - from - a) / a, 2)));
    };
    const double even = mass / (pi * a * width / 2 * thickness); // density that spreads it so
    const auto area = [&](double z) { return 2 * half(z) * thickness; };
    const auto across = [&](double z) { return 2 * half(z) * std::pow(thickness, 3) / 12; };
    const auto along = [&](double z) { return thickness * std::pow(2 * half(z), 3) / 12; };
    require_same(leaf_blade(length, width, thickness, 800), sliced(from, length, even, area, across, along), 1e-5);
    // The clump: an ellipsoid of semi-axes width/2, 0.3 width, length/2.
    const double x = width / 2, y = 0.3 * width, c = length / 2, filled = mass / (4 * pi / 3 * x * y * c);
    const auto r2 = [&](double z) { return 1 - std::pow((z - c) / c, 2); };
    const auto disc = [&](double z) { return pi * x * y * r2(z); };
    const auto about_x = [&](double z) { return disc(z) * y * y * r2(z) / 4; };
    const auto about_y = [&](double z) { return disc(z) * x * x * r2(z) / 4; };
    require_same(leaf_clump(length, width, thickness, 800), sliced(0, length, filled, disc, about_x, about_y), 1e-10);
}

TEST_CASE("sphere equals the sum of its discs") {
    const double center = 0.05, radius = 0.03;
    const auto r2 = [&](double z) { return std::max(0.0, radius * radius - (z - center) * (z - center)); };
    const auto area = [&](double z) { return pi * r2(z); };
    const auto disc = [&](double z) { return pi * r2(z) * r2(z) / 4; };
    require_same(sphere(center, radius, 850), sliced(center - radius, center + radius, 850, area, disc, disc), 1e-10);
}

TEST_CASE("sections are the shadows of the bodies") {
    CHECK(frustum_section(2, 0.3, 0.1) ==
          Approx(integrate([](double z) { return 2 * (0.3 - 0.1 * z); }, 0, 2)).epsilon(1e-12));
    CHECK(leaf_area(0.09, 0.06) ==
          Approx(integrate([](double z) { return 0.06 * (1 - z / 0.09); }, 0, 0.09)).epsilon(1e-12));
    const auto chord = [](double a) { return 2 * 0.03 * 0.03 * std::cos(a) * std::cos(a); }; // x = r sin a
    CHECK(sphere_section(0.03) == Approx(integrate(chord, -pi / 2, pi / 2)).epsilon(1e-12));
}
