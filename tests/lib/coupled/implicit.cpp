// The scheme with the one real pole at 1 (LIE) against the linearly implicit articulated step, which is written in other
// coordinates: body rates w = J theta_dot. At theta = 0 both charts have the same rates and rates' changes (J = 1, J_dot
// theta_dot = 0), so that one step from there is one method.
#include "tests/support/coupled_cases.h"
#include "tests/support/coupled_support.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace coupled;

namespace {

struct Steady {
    Vec3 v = Vec3::Zero(), a = Vec3::Zero(), omega = Vec3::Zero();
    bool moves() const { return !v.isZero() || !a.isZero() || !omega.isZero(); }
};

// After one step from theta = 0 with random rates: the largest difference of theta_dot, and of theta, relative to the largest.
double difference(const Tree& tree, Scene scene, const Steady& ground, double rate, double h = 1.0 / 30) {
    if (ground.moves()) scene.root_motion = {two_keys()};
    const std::vector<TreeRange> whole{{0, tree.size_bodies(), 0}};
    auto ours = make_plan<double>(tree, whole, scene, {}, h, Solver::coupled, Scheme::lie);
    auto theirs = make_plan<double>(tree, whole, scene, {}, h, Solver::articulated_implicit);
    if (ground.moves()) ours.splines = theirs.splines = {steady_ground(ground.v, ground.a, ground.omega)};
    State<double> a = make_state(ours), b = make_state(theirs);
    make_tree::Dice dice{std::mt19937(11)};
    for (std::size_t i = 0; i < ours.bodies; ++i)
        a.theta_dot[i] = b.theta_dot[i] = parts::scaled_rate(b)[i] = solver::random_vector(dice, rate);
    a.step = b.step = std::llround(0.5 / h);
    advance(ours, a);
    advance(theirs, b);
    CHECK(a.flags.fast_turns + b.flags.fast_turns + a.flags.half_turns == 0);
    double angle = 0, angles = 0, speed = 0, speeds = 0;
    for (std::size_t i = 0; i < ours.bodies; ++i) {
        angle = std::max(angle, (a.theta[i] - b.theta[i]).norm());
        speed = std::max(speed, (a.theta_dot[i] - parts::scaled_rate(b)[i]).norm());
        angles = std::max(angles, b.theta[i].norm());
        speeds = std::max(speeds, parts::scaled_rate(b)[i].norm());
    }
    return std::max(angle / angles, speed / speeds);
}

Tree tree_off_origin() {
    Tree tree = leafy(2e8, 0.01);
    tree.joint_position[0] = Vec3(0.7, 0.2, -0.4);
    return tree;
}

Scene steady_wind() {
    Scene scene = solver::empty_scene();
    scene.wind = Wind();
    scene.wind->velocity = Vec3(3, 0.5, 1);
    scene.wind->profile = 0;
    return scene;
}

} // namespace

TEST_CASE("With springs, dampers and turning bodies alone, LIE is the linearly implicit articulated step") {
    CHECK(difference(tree_off_origin(), solver::empty_scene(), {}, 0.5) < 1e-11);
}

// Another difference of principle, as with gravity: L here has what pulls make of their points' turning with the bodies (pulled_points.h).
TEST_CASE("With pulls, steady or changing, they differ by what their points resist turning by, second order in h") {
    for (const bool changing : {false, true}) {
        Scene scene = solver::empty_scene();
        scene.pulls = {pull_on(3, Vec3(1, 0, -4), changing ? Vec3(-8, 1, 2) : Vec3(1, 0, -4)),
                       pull_on(9, Vec3(0, 0.1, 0), changing ? Vec3(0.2, 0.1, 0.5) : Vec3(0, 0.1, 0))};
        const double coarse = difference(paper_trees::branched(2e7, 0), scene, {}, 0.5, 2e-4),
                     fine = difference(paper_trees::branched(2e7, 0), scene, {}, 0.5, 1e-4);
        CAPTURE(changing, coarse, fine);
        CHECK(coarse < 2e-2);
        CHECK(coarse > 1e-8);
        CHECK(std::log2(coarse / fine) == Approx(2).margin(0.2));
    }
}

TEST_CASE("So it is on a driven ground, and on a turning one") {
    CHECK(difference(tree_off_origin(), solver::empty_scene(), {Vec3(3, -1, 2), Vec3(4, 5, -6), Vec3::Zero()}, 0.5) <
          1e-11);
    CHECK(difference(tree_off_origin(), solver::empty_scene(), {Vec3::Zero(), Vec3::Zero(), Vec3(0.5, 2, -1)}, 0.5) <
          1e-11);
}

TEST_CASE("So it is in a steady wind on leaves, from rest, on a driven ground too") {
    CHECK(difference(tree_off_origin(), steady_wind(), {}, 0) < 1e-11);
    CHECK(difference(tree_off_origin(), steady_wind(), {Vec3(3, -1, 2), Vec3(4, 5, -6), Vec3::Zero()}, 0) < 1e-11);
}

// Linear in the wind about its middle, ours is off the wind's force at the end by the square of the wind's change. Without
// leaves: of a plate's force the damping knows the part along its normal alone, a first-order share of the change.
TEST_CASE("In a wind that changes both take that at the end of the step, but for second order in h") {
    Scene scene = steady_wind();
    scene.wind->velocity = Vec3(6, 0, 0);
    scene.wind->gust_factor = 2;
    scene.wind->gust_period = 0.7; // falling at half a second
    const Tree tree = paper_trees::branched(2e8, 0.01);
    const double coarse = difference(tree, scene, {}, 0, 4e-3), fine = difference(tree, scene, {}, 0, 2e-3);
    CAPTURE(coarse, fine);
    CHECK(coarse < 1e-2);
    CHECK(coarse > 1e-8);
    CHECK(std::log2(coarse / fine) == Approx(2).margin(0.2));
}

// The one difference of principle: the articulated step lets the air damp the velocities at the step's end with all that
// brings them there, turning bodies' own accelerations a_0 too (h D a_0); L here has the velocities' change with the joints'
// rates alone. It is of second order in h in the rates, above the first order of the method.
TEST_CASE(
    "In the wind with turning bodies they differ by the air's damping of centripetal acceleration, second order in h") {
    const double coarse = difference(tree_off_origin(), steady_wind(), {}, 0.5, 1e-3);
    const double fine = difference(tree_off_origin(), steady_wind(), {}, 0.5, 5e-4);
    CAPTURE(coarse, fine);
    CHECK(coarse < 1e-2);
    CHECK(coarse > 1e-6);
    CHECK(std::log2(coarse / fine) == Approx(2).margin(0.2));
}
