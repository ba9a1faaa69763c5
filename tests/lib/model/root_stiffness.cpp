// Ground that gives way (root_stiffness.h), beside Euler and Bernoulli's beam on a hinge with a spring.
#include "lib/model/root_stiffness.h"
#include "lib/growth/segment.h"
#include "lib/study/modes.h"
#include "tests/support/make_tree.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;

namespace {

using std::numbers::pi;
constexpr double length = 2, radius = 0.02;

Tree pole(const Material& wood, int pieces) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {Vec3(0, 0, 0), Vec3(0, length, 0)};
    s.radius = {radius, radius};
    SegmentOptions options;
    options.segment_length = length / pieces * 1.0000001;
    return segment(s, wood, options);
}

// [Hz] The lowest of 1 + cos x cosh x = (x / k) (sin x cosh x - cos x sinh x), k the spring in units of E I / length.
double beam_on_spring(const Material& wood, double stiffness) {
    const double EI = wood.youngs_modulus * pi * std::pow(radius, 4) / 4, k = stiffness * length / EI;
    double low = 1e-6, high = 1.8751041;
    for (int i = 0; i < 100; ++i) {
        const double x = (low + high) / 2;
        const double left = 1 + std::cos(x) * std::cosh(x),
                     right = x / k * (std::sin(x) * std::cosh(x) - std::cos(x) * std::sinh(x));
        (left > right ? low : high) = x;
    }
    return low * low / (2 * pi * length * length) * std::sqrt(EI / (wood.density * pi * radius * radius));
}

std::vector<NaturalMode> modes_of(const Tree& tree) {
    Scene scene;
    scene.gravity.setZero();
    return natural_modes(SmallMotion(tree, Vec3::Zero(), Pose::drawn), tree, scene, {2, false});
}

} // namespace

TEST_CASE("a pole on a spring sways as the beam does, and is damped as wood is") {
    const Material wood = wood_presets().front();
    const double EI = wood.youngs_modulus * pi * std::pow(radius, 4) / 4;
    for (const double k : {0.1, 1.0, 3.0, 30.0}) {
        Tree tree = pole(wood, 100);
        const Vec3 drawn = tree.stiffness[0];
        CHECK(stand_on_springs(tree, k * EI / length) == 1);
        CHECK(tree.stiffness[0].x() < k * EI / length);
        CHECK(tree.stiffness[0].z() == drawn.z());
        for (const NaturalMode& mode : modes_of(tree)) {
            CHECK(mode.frequency == Approx(beam_on_spring(wood, k * EI / length)).epsilon(1e-3));
            CHECK(mode.damping == Approx(wood.damping_ratio).epsilon(5e-3));
        }
    }
}

TEST_CASE("only what stands on the ground gets softer, a trunk at a time") {
    Tree tree = make_tree::forest({make_tree::branched(), make_tree::branched()});
    const Tree drawn = tree;
    CHECK(stand_on_springs(tree, 100) == 2);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const double K = drawn.stiffness[i][axis];
            const bool softer = drawn.parent[i] < 0 && axis < 2;
            CHECK(tree.stiffness[i][axis] == Approx(softer ? 1 / (1 / K + 1.0 / 100) : K).epsilon(1e-14));
        }
}
