#include "lib/growth/segment.h"
#include "lib/model/sway.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

// An upright rod of 4 m, base radius r, tip radius r_tip, cut into n pieces.
Tree rod(double r, double r_tip, int n) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {{0, 0, 0}, {0, 4, 0}};
    s.radius = {r, r_tip};
    SegmentOptions options;
    options.segment_length = 4.0 / n;
    return segment(s, wood_presets().front(), options);
}

} // namespace

TEST_CASE("A rod's sway is the cantilever's first frequency") {
    const Material& wood = wood_presets().front();
    const double beam = 2 * 0.03 / 16 * std::sqrt(wood.youngs_modulus / wood.density);
    // Rayleigh's quotient of the static shape is 0.4 % above for the uniform rod; 80 pieces add less than 0.1 %.
    CHECK(sway_frequency(rod(0.03, 0.03, 80), Vec3::UnitX(), 0) == Approx(0.1399 * beam).epsilon(0.008));
    CHECK(sway_frequency(rod(0.03, 0.03, 80), Vec3::UnitZ(), 0) == Approx(0.1399 * beam).epsilon(0.008));
    const double cone = sway_frequency(rod(0.03, 3e-4, 160), Vec3::UnitX(), 0) / (0.3469 * beam);
    CHECK(cone > 1);
    CHECK(cone < 1.04);
}

TEST_CASE("Weight slows a standing rod and quickens a hanging one") {
    // Ritz with the shape of a uniform load: omega^2 falls by the weight over the buckling weight 7.84 E I / L^2, to 2 %.
    const Material& wood = wood_presets().front();
    const double radius = 0.006, length = 4, area = M_PI * radius * radius;
    const double weight = wood.density * area * length * 9.81;
    const double buckling = 7.837 * wood.youngs_modulus * M_PI / 4 * std::pow(radius, 4) / (length * length);
    REQUIRE(weight < 0.9 * buckling);
    REQUIRE(weight > 0.3 * buckling);
    Tree tree = rod(radius, radius, 80);
    const double still = sway_frequency(tree, Vec3::UnitX(), 0);
    const double standing = std::pow(sway_frequency(tree, Vec3::UnitX()) / still, 2);
    CHECK(standing == Approx(1 - weight / buckling).margin(0.02));
    tree.joint_rotation[0] = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())); // hanging from the ceiling
    CHECK(std::pow(sway_frequency(tree, Vec3::UnitX()) / still, 2) == Approx(1 + weight / buckling).margin(0.02));
    CHECK(sway_frequency(rod(0.002, 0.002, 80), Vec3::UnitX()) == 0); // longer than it can stand
}
