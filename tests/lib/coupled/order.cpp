// Orders of the coupled step's schemes, load by load, and its limit of small steps: against articulated_reference, which
// is written in other coordinates, solves other systems and says how far it is to be trusted (tests/lib/study/reference.cpp).
#include "tests/support/coupled_support.h"

using namespace bough;
using namespace coupled;
using solver::empty_scene;

namespace {

// Three balls on one another's stalks with springs of three stiffnesses, far from rest about oblique axes. Compact bodies:
// no mode is too fast for the steps, so that what is left is the chart's.
coupled::Motion balls() {
    coupled::Motion motion{{}, empty_scene(), 20, {Vec3(1.2, -0.8, 0.9), Vec3(-0.7, 0.9, 0.6), Vec3(0.5, 1.1, -0.9)}};
    for (int i = 0; i < 3; ++i) {
        const Vec3 at = i == 0 ? Vec3(0.3, 0.1, 0) : Vec3(0, 0.05, 0.4);
        make_tree::add_fruit(motion.tree, i - 1, at, make_tree::turn(0.5 + i, Vec3(1, 2, 3)), 0.2, 0.1, 0, 0, 0);
        motion.tree.stiffness[std::size_t(i)] = Vec3(30, 45, 20);
        motion.tree.kind[std::size_t(i)] = Kind::branch; // tips are branches' ends
        motion.tree.size[std::size_t(i)] = Vec3(0.3, 0.1, 0.1);
    }
    return motion;
}

Scene gravity() {
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    return scene;
}

Scene order_gusts() {
    Scene scene = empty_scene();
    scene.wind = Wind();
    scene.wind->velocity = Vec3(8, 0, 2.4);
    scene.wind->profile = 0; // the field's table over height has corners
    scene.wind->gust_factor = 1.5;
    scene.wind->gust_period = 0.7;
    return scene;
}

Scene pulled() {
    Scene scene = empty_scene();
    scene.pulls = {pull_on(3, Vec3(1, 0, -4), Vec3(-8, 1, 2)), pull_on(5, Vec3(0, 0.1, 0), Vec3(0.2, 0.1, 0.5))};
    return scene;
}

// Turns and goes at once, in velocities and accelerations that change.
RootSpline drive() {
    RootSpline s;
    s.position = QuinticSpline{
        {0, 2}, {Vec3::Zero(), Vec3(0.6, 0.2, -0.3)}, {Vec3::Zero(), Vec3(1, 0, -1)}, {Vec3::Zero(), Vec3(3, 1, 0)}};
    s.rotation = QuinticSpline{
        {0, 2}, {Vec3::Zero(), Vec3(0.5, 1.5, -0.3)}, {Vec3::Zero(), Vec3(0.5, -1, 1)}, {Vec3::Zero(), Vec3(-1, 2, 3)}};
    return s;
}

coupled::Motion driven(Tree tree) {
    tree.joint_position[0] = Vec3(0.7, 0.2, -0.4); // off what the ground turns about
    return {tree, empty_scene(), 20, {}, drive()};
}

// n steps a frame and twice that.
void has_order(const coupled::Motion& motion, int n, double order, const std::vector<Scheme>& schemes) {
    const Track truth = truth_of(motion);
    for (const Scheme scheme : schemes) {
        CAPTURE(motion.tree.name, scheme_of(scheme).name);
        CHECK(order_at(motion, truth, scheme, n) >= order);
    }
    CHECK(order_at(motion, truth, Scheme::lie, 64) == Approx(1).margin(0.1));
}

const std::vector<Scheme> second_order{Scheme::p12, Scheme::p34};

} // namespace

TEST_CASE("order 2, theta chart: springs alone, at large rotations") {
    has_order(balls(), 16, 1.9, {extrapolating.begin(), extrapolating.end()});
}

TEST_CASE("order 2, gravity switched on") {
    has_order({paper_trees::chain(2e9, 0.01), gravity(), 20}, 8, 1.9, second_order);
    has_order({paper_trees::branched(2e9, 0.01), gravity(), 20}, 8, 1.9, second_order);
}

TEST_CASE("order 2, wind with drag") {
    has_order({paper_trees::chain(2e9, 0.01), order_gusts(), 20}, 8, 1.9, second_order);
    has_order({paper_trees::branched(2e8, 0.01), order_gusts(), 20}, 8, 1.9, second_order);
}

TEST_CASE("order 2, moving root: going and turning, the tree off the pivot") {
    has_order(driven(paper_trees::branched(2e8, 0.01)), 8, 1.9, second_order);
    has_order(driven(paper_trees::branched(2e9, 0.01)), 8, 1.9, second_order);
}

TEST_CASE("order 2, pulls that change") {
    has_order({paper_trees::branched(2e9, 0.01), pulled(), 20}, 8, 1.9, second_order);
}

// What is stiff follows a changing load with a lag where R(infinity) = 0: the thin end of a bent chain in order_gusts, first order
// in h and small.
TEST_CASE("wind on a bent chain of E = 2e9: the L-stable schemes fall to order 1 below an error of 2e-4") {
    coupled::Motion motion{paper_trees::chain(2e9, 0.01), order_gusts(), 20};
    motion.scene.gravity = Vec3(0, -9.81, 0);
    motion.scene.pose = Pose::settled;
    const Track truth = truth_of(motion);
    for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
        CAPTURE(scheme_of(scheme).name);
        const double before = error_of(motion, truth, scheme, 8);
        CHECK(before < 2e-4);
        CHECK(std::log2(before / error_of(motion, truth, scheme, 16)) < 1.5);
        CHECK(order_at(motion, truth, scheme, 16) == Approx(1).margin(0.25));
    }
}

TEST_CASE(
    "small steps go to the reference: within 1e-6 of the deflection under each load, on chain and branched tree") {
    for (const bool branched : {false, true}) {
        const Tree tree = branched ? paper_trees::branched(2e8, 0.01) : paper_trees::chain(2e8, 0.01);
        Scene all = order_gusts();
        all.pulls = pulled().pulls;
        all.gravity = gravity().gravity;
        coupled::Motion everything = driven(tree);
        everything.scene = all;
        everything.frames = 10;
        for (const coupled::Motion& motion :
             {coupled::Motion{tree, gravity(), 20}, coupled::Motion{tree, order_gusts(), 20},
              coupled::Motion{tree, pulled(), 20}, driven(tree), everything}) {
            const Track truth = truth_of(motion);
            CAPTURE(branched, motion.scene.wind.has_value(), motion.scene.gravity.norm(), motion.scene.pulls.size());
            // (A strong pull bends the thin end: order 1, as above.)
            CHECK(error_of(motion, truth, Scheme::p34, 256) < (motion.scene.pulls.empty() ? 1e-6 : 1e-5));
        }
    }
    const coupled::Motion motion = balls();
    CHECK(error_of(motion, truth_of(motion), Scheme::p34, 1024) < 1e-6);
}
