#include "lib/model/stiffness.h"
#include "lib/growth/segment.h"
#include "tests/support/integrate.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using std::numbers::pi;

namespace {

// One straight upright branch with the given radius at each of its points.
Splines rod(double length, double radius_base, double radius_tip) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {{0, 0, 0}, {0, length, 0}};
    s.radius = {radius_base, radius_tip};
    return s;
}

SegmentOptions pieces(double length, int n) {
    SegmentOptions o;
    o.segment_length = length / n;
    return o;
}

const Material& wood() {
    return wood_presets().front();
}

// Sideways deflection at the tip of a rod of equal pieces under a sideways load P there: sum of P (L - x)^2 / K.
double tip_deflection(const Tree& tree, double length, double load) {
    double sum = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const double arm = length - tree.s[i] * length;
        sum += load * arm * arm / tree.stiffness[i].x();
    }
    return sum;
}

} // namespace

TEST_CASE("integral of 1/r^4 equals numerical integration for any taper") {
    for (const auto& [a, b] : {std::pair{0.1, 0.1}, {0.1, 0.05}, {0.05, 0.1}, {1e-3, 1e-2}, {0.1, 0.1 + 1e-13}}) {
        const auto f = [a = a, b = b](double z) { return std::pow(a + (b - a) * z / 0.7, -4); };
        CHECK(integral_r4(0.7, a, b) == Approx(integrate(f, 0, 0.7, 20000)).epsilon(1e-9));
    }
}

TEST_CASE("a joint's compliance is that of the wood between the middles of its pieces") {
    const double length = 3, n = 6;
    const Tree tree = segment(rod(length, 0.08, 0.02), wood(), pieces(length, int(n)));
    REQUIRE(tree.size_bodies() == 6);
    const auto bend = [&](double z) { return 4 / (wood().youngs_modulus * pi * std::pow(0.08 - 0.02 * z, 4)); };
    const auto twist = [&](double z) { return 2 / (wood().shear_modulus * pi * std::pow(0.08 - 0.02 * z, 4)); };
    for (std::size_t i = 0; i < 6; ++i) {
        const double from = std::max(0.0, (double(i) - 0.5) * length / n), to = (double(i) + 0.5) * length / n;
        CHECK(tree.stiffness[i].x() == Approx(1 / integrate(bend, from, to)).epsilon(1e-10));
        CHECK(tree.stiffness[i].y() == tree.stiffness[i].x());
        CHECK(tree.stiffness[i].z() == Approx(1 / integrate(twist, from, to)).epsilon(1e-10));
    }
}

TEST_CASE("tip of a uniform cantilever: P L^3 / 3 E I, second order in the pieces") {
    const double length = 2, radius = 0.02, load = 5;
    const double truth = load * std::pow(length, 3) / (3 * wood().youngs_modulus * pi * std::pow(radius, 4) / 4);
    for (int n : {5, 10, 20, 40, 320}) {
        const Tree tree = segment(rod(length, radius, radius), wood(), pieces(length, n));
        CHECK(tip_deflection(tree, length, load) / truth == Approx(1 + 1 / (2.0 * n * n)).epsilon(1e-10));
    }
}

TEST_CASE("tip of a tapered cantilever: to the integral of P (L - x)^2 / E I, second order in the pieces") {
    const double length = 4, load = 5;
    const auto f = [&](double x) {
        const double I = pi * std::pow(0.06 - 0.01 * x, 4) / 4;
        return load * (length - x) * (length - x) / (wood().youngs_modulus * I);
    };
    const double truth = integrate(f, 0, length);
    double before = 0;
    for (int n : {10, 20, 40, 80}) {
        const Tree tree = segment(rod(length, 0.06, 0.02), wood(), pieces(length, n));
        const double error = std::abs(tip_deflection(tree, length, load) / truth - 1);
        if (before > 0) CHECK(before / error == Approx(4).epsilon(0.1));
        before = error;
    }
    CHECK(before < 1e-3);
}

TEST_CASE("tip moment twists a rod by its whole compliance but the last half piece") {
    const double length = 4;
    const Tree tree = segment(rod(length, 0.06, 0.02), wood(), pieces(length, 8));
    double compliance = 0;
    for (const Vec3& K : tree.stiffness) compliance += 1 / K.z();
    const auto f = [](double x) { return 2 / (wood().shear_modulus * pi * std::pow(0.06 - 0.01 * x, 4)); };
    CHECK(compliance == Approx(integrate(f, 0, length * 7.5 / 8)).epsilon(1e-10));
}

TEST_CASE("a side branch's joint has its own half piece only") {
    Splines s = rod(3, 0.1, 0.05);
    s.parent.push_back(0);
    s.parent_at.push_back(0.5);
    s.level.push_back(1);
    s.point.insert(s.point.end(), {{0, 1.5, 0}, {1, 1.5, 0}});
    s.radius.insert(s.radius.end(), {0.02, 0.02});
    s.first_point.push_back(4);
    const Tree tree = segment(s, wood(), pieces(1, 4));
    std::size_t base = 0;
    while (tree.branch[base] == 0) ++base;
    CHECK(tree.stiffness[base].x() ==
          Approx(wood().youngs_modulus * pi * std::pow(0.02, 4) / 4 / 0.125).epsilon(1e-12));
}

TEST_CASE("beta gives the damping ratio at the beam's first frequency, whatever the segmentation") {
    const double length = 3, radius = 0.03;
    // First frequency of a uniform cantilever: 0.1399 (D / L^2) sqrt(E / rho).
    const double omega =
        2 * pi * 0.1399 * 2 * radius / (length * length) * std::sqrt(wood().youngs_modulus / wood().density);
    for (int n : {5, 10, 40, 160}) {
        const Tree tree = segment(rod(length, radius, radius), wood(), pieces(length, n));
        for (double beta : tree.damping)
            CHECK(beta * omega / 2 == Approx(wood().damping_ratio).epsilon(n == 5 ? 0.03 : 0.02));
    }
}

TEST_CASE("a leaf droops and swings on its petiole as documented") {
    for (double length : {0.02, 0.075, 0.15, 0.3}) {
        Tree tree;
        tree.resize(1);
        tree.parent[0] = -1;
        tree.kind[0] = Kind::leaf;
        tree.size[0] = {length, 0.7 * length, wood().leaf_thickness};
        tree.joint_position[0] = Vec3::Zero();
        tree.joint_rotation[0] = Quat::Identity();
        set_mass(tree, wood());
        set_stiffness(tree, wood());
        set_damping(tree, wood());
        const Vec3 K = tree.stiffness[0];
        CHECK(tree.mass[0] * 9.81 * tree.com[0].z() / K.x() == Approx(0.175).epsilon(0.02));
        const double inertia = tree.inertia[0](0, 0) + tree.mass[0] * tree.com[0].squaredNorm();
        const double omega = std::sqrt(K.x() / inertia);
        if (length == 0.075) CHECK(omega / (2 * pi) == Approx(5.17).epsilon(0.01)); // a blade of 5 cm
        if (length == 0.15) CHECK(omega / (2 * pi) == Approx(3.66).epsilon(0.01));  // and of 10 cm
        // A cantilever's tip moves under a force at an arm a beyond it by F (l^3/3 + l^2 a + l a^2) / (E I) there: half a blade is a petiole long.
        CHECK(K.x() / K.z() == Approx(4.3 * 4 / (1 / 3.0 + 1 + 1)));
        // Swaying turns the blade in its plane: a little more inertia, the same spring, so a lower omega.
        CHECK(tree.damping[0] * omega / 2 == Approx(wood().leaf_damping_ratio).epsilon(0.1));
    }
}

TEST_CASE("a fruit's stalk is a rod from joint to skin") {
    const double length = 0.02, radius = 0.035;
    const double I = pi * std::pow(0.04 * radius, 4) / 4;
    const Vec3 K = fruit_stiffness(wood(), length + radius, radius);
    CHECK(K.x() == Approx(wood().leaf_modulus * I / length));
    CHECK(fruit_stiffness(wood(), radius, radius).x() == Approx(wood().leaf_modulus * I / (radius / 2)));
}
