// settling.h: the first sway by one shape, held against a beam's formula, against Lanczos' modes, and against how long runs remember.
#include "lib/plan/settling.h"
#include "lib/laws/wind_field.h"
#include "lib/study/modes.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace bough;

namespace {

TreeRange range_of(const Tree& tree) {
    return {0, tree.size_bodies(), 0};
}

// A uniform rod of `pieces`, standing; E [Pa], rho [kg/m^3], beta [s].
Tree rod(int pieces, double length, double radius, double E, double rho, double beta) {
    Tree t;
    for (int i = 0; i < pieces; ++i)
        make_tree::add_piece(t, i - 1, i == 0 ? Vec3(0, 0, 0) : Vec3(0, 0, length / pieces),
                             i == 0 ? make_tree::upright() : Quat(Quat::Identity()), length / pieces, radius, radius, 0,
                             0, double(i) / pieces, {rho, E, E / 2, beta});
    return t;
}

} // namespace

TEST_CASE("a clamped rod's first sway is the beam's, its damping the wood's") {
    // f1 = 0.1399 (D / L^2) sqrt(E / rho); each joint here has the stiffness of a whole piece, so that n pieces bend as a beam for n -> infinity.
    const double D = 0.06, L = 3, E = 9e9, rho = 900, beta = 0.004;
    const Tree tree = rod(60, L, D / 2, E, rho, beta);
    Scene scene;
    scene.gravity = Vec3::Zero();
    const FirstSway sway = first_sway(tree, range_of(tree), scene);
    const double beam = 2 * std::numbers::pi * 0.1399 * D / (L * L) * std::sqrt(E / rho);
    CHECK(sway.omega == Approx(beam).epsilon(0.03)); // the static bend's quotient is the first mode's to a percent
    CHECK(sway.zeta == Approx(beta * sway.omega / 2).epsilon(1e-3));
}

TEST_CASE("in the wind a rod's sway is damped by the drag of its speed past the air") {
    // Across a rod in a wind of U, drag / speed is 2 x (C/2) rho_air d U a metre along the wind: zeta = that / (2 omega m).
    const double D = 0.06, L = 3, E = 9e9, rho = 900, U = 8;
    const Tree tree = rod(60, L, D / 2, E, rho, 0);
    Scene scene;
    scene.gravity = Vec3::Zero();
    scene.wind = Wind();
    scene.wind->velocity = Vec3(0, 0, U);
    scene.wind->profile = 0;
    const FirstSway sway = first_sway(tree, range_of(tree), scene);
    const double drag = 1.2 * scene.air_density * D * U, mass = rho * std::numbers::pi * D * D / 4; // a metre
    CHECK(sway.zeta == Approx(drag / (2 * sway.omega * mass)).epsilon(1e-3));
    CHECK(settling_time(tree, {range_of(tree)}, scene) ==
          Approx(std::min(20.0, std::max(2.0, std::log(100) / (sway.zeta * sway.omega)))).epsilon(1e-3));
}

TEST_CASE("in the wind a single leaf's sway is damped as that of one which turns with it, where it is not narrow") {
    // A blade that stands as a rod does. zeta = D / (2 omega m), D the slope of its drag kappa rho A c G U^2, c 1 broadside and 1/4 edge on (air.h).
    const double U = 8;
    for (const double width : {0.9, 0.15}) {
        Tree tree = rod(1, 1.5, 0.01, 9e9, 900, 0);
        tree.kind[0] = Kind::leaf;
        tree.size[0] = {1.5, width, 2e-4};
        const auto pushed = [&](double u) {
            const double h = width > 0.5 ? 0.66 + 0.34 / (1 + std::pow(u / 7.2, 4)) : 1;
            return h / (1 + u / 7.5) * u * u;
        };
        const double slope = (pushed(U + 1e-4) - pushed(U - 1e-4)) / 2e-4;
        std::vector<double> zetas, expected;
        for (const Vec3& along : {Vec3(U, 0, 0), Vec3(0, 0, U)}) {
            Scene scene;
            scene.gravity = Vec3::Zero();
            scene.wind = Wind();
            scene.wind->velocity = along;
            scene.wind->profile = 0;
            const FirstSway sway = first_sway(tree, range_of(tree), scene);
            const double area = 1.2 / 2 * scene.air_density * 1.5 * width / 2;
            zetas.push_back(sway.zeta);
            expected.push_back(area * slope / (2 * sway.omega * tree.mass[0]));
        }
        std::sort(zetas.begin(), zetas.end());
        CAPTURE(width);
        CHECK(zetas[0] == Approx(0.25 * expected[0]).epsilon(1e-6));
        CHECK(zetas[1] == Approx(expected[1]).epsilon(1e-6));
    }
}

TEST_CASE("a grown tree's first sway lies among the modes that Lanczos finds") {
    for (const char* species : {"maple", "oak", "pine"}) {
        const Tree tree = convert(grow(species, {.bodies = 400, .seed = 2}));
        Scene scene;
        const FirstSway sway = first_sway(tree, range_of(tree), scene);
        const SmallMotion small(tree, scene.gravity, scene.pose);
        const double lowest = natural_modes(small, tree, scene, {.count = 1}).front().frequency;
        const double hertz = sway.omega / (2 * std::numbers::pi);
        INFO(species << ": " << hertz << " Hz, lowest mode " << lowest);
        CHECK(hertz > 0.99 * lowest); // Rayleigh's quotient is a bound from above
        CHECK(hertz < 4 * lowest);
    }
}

TEST_CASE("where no wind blows nothing has to be forgotten; without damping it takes the most that is run") {
    const Tree tree = rod(10, 2, 0.03, 9e9, 900, 0);
    Scene scene;
    CHECK(settling_time(tree, {range_of(tree)}, scene) == 0);
    scene.wind = Wind(); // of no velocity: still air
    CHECK(settling_time(tree, {range_of(tree)}, scene) == 0);
    scene.wind->velocity = Vec3(1e-9, 0, 0);
    CHECK(settling_time(tree, {range_of(tree)}, scene) == most_settling);
    scene.wind->velocity = Vec3::Zero();
    scene.wind->grid = WindGrid();
    scene.wind->grid->velocity = {Vec3::Zero(), Vec3(3, 0, 0)};
    CHECK(blows(*scene.wind));
}
