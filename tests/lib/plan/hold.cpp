// Which joints a scene holds, and what that is estimated to lose.
#include "lib/plan/hold.h"
#include "lib/lanes/target.h"
#include "lib/laws/added_motion.h"
#include "lib/model/drawn_pose.h"
#include "lib/study/rigid_error.h"
#include "lib/study/solvers.h"
#include "tests/support/held_joints.h"
#include "tests/support/make_tree.h"
#include "tests/support/paper_trees.h"
#include "tests/support/reduced.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using held_joints::run_both;
using reduced::all_of;
using simulate::steady;

namespace {

struct Held {
    Tree tree;
    HeldJoints count;
    bool moves(std::size_t i) const { return tree.rigid.empty() || tree.rigid[i] == 0; }
};
Held hold(Tree tree, const Simulate& by, Scene scene = {}) {
    scene.simulate = by;
    Held held{std::move(tree), {}};
    held.count = hold_rigid(held.tree, all_of(held.tree), scene);
    return held;
}

} // namespace

TEST_CASE("levels, radius, subtrees and a box hold what is outside them, and what grows there") {
    const Tree tree = make_tree::random_tree(300, 21);
    Simulate levels;
    levels.last_level = 0;
    const Held trunk = hold(tree, levels);
    std::size_t moving = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK(trunk.moves(i) == (tree.level[i] <= 0)); // of a leaf: its branch's
        moving += trunk.moves(i);
    }
    CHECK(trunk.count.moving == moving);
    CHECK(trunk.count.level == tree.size_bodies() - moving);
    levels.last_level.reset();
    levels.first_level = 1;
    const Held crown = hold(tree, levels);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) CHECK(crown.moves(i) == (tree.level[i] >= 1));

    Simulate thick;
    thick.radius = 0.02;
    const Held stout = hold(tree, thick);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::size_t on = tree.kind[i] == Kind::branch ? i : std::size_t(tree.parent[i]);
        CHECK(stout.moves(i) == (tree.size[on][1] >= 0.02));
    }

    Simulate under;
    Selector one;
    one.body = 7;
    under.subtrees = {one};
    const Held part = hold(tree, under);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        bool below = false;
        for (std::int64_t j = std::int64_t(i); j >= 0; j = tree.parent[std::size_t(j)]) below = below || j == 7;
        CHECK(part.moves(i) == below);
    }

    Simulate inside;
    inside.box = Simulate::Box{Vec3(-0.2, 0, -10), Vec3(10, 1.5, 10)};
    const Held boxed = hold(tree, inside);
    const DrawnPose drawn = drawn_pose(tree);
    std::size_t in = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3& x = drawn.x_w[i];
        const bool within = x.x() >= -0.2 && x.x() <= 10 && x.y() >= 0 && x.y() <= 1.5 && std::abs(x.z()) <= 10;
        CHECK(boxed.moves(i) == within);
        in += within;
    }
    CHECK((in > 0 && in < tree.size_bodies()));

    // All of them together, and the tree's own: a joint moves where all let it, and is counted once.
    Tree own = tree;
    own.rigid.assign(own.size_bodies(), 0);
    own.rigid[40] = 1;
    Simulate every = inside;
    every.radius = 0.02;
    every.last_level = 1;
    const Held both = hold(own, every);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        CHECK(both.moves(i) == (boxed.moves(i) && stout.moves(i) && tree.level[i] <= 1 && i != 40));
    const HeldJoints& c = both.count;
    CHECK(c.document == 1);
    CHECK(c.document + c.level + c.radius + c.subtrees + c.box + c.error + c.moving == c.joints);
    CHECK(text_of(c).rfind(std::to_string(c.moving) + " of 300 joints move; held: 1 by the tree's /rigid", 0) == 0);
}

TEST_CASE("nothing held leaves the tree as it is") {
    Simulate by;
    by.last_level = 9;
    CHECK(hold(make_tree::branched(), by).tree.rigid.empty());
}

TEST_CASE("small motions are held from the ends inward, up to their sum on each way to the ground") {
    Tree tree = make_tree::random_tree(250, 33);
    make_tree::Dice dice{std::mt19937(1)};
    std::vector<double> motion(tree.size_bodies());
    for (double& m : motion) m = dice(0, 1) < 0.1 ? std::numeric_limits<double>::infinity() : dice(0, 0.4);
    const std::size_t held = hold_small(tree, motion, 1.0);
    CHECK(held == std::size_t(std::count(tree.rigid.begin(), tree.rigid.end(), 1)));
    CHECK((held > 50 && held < 240));
    std::vector<double> sum(tree.size_bodies()), worst(tree.size_bodies(), 0);
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double below = tree.parent[i] < 0 ? 0 : sum[std::size_t(tree.parent[i])];
        sum[i] = below + (tree.rigid[i] ? motion[i] : 0);
        CHECK(sum[i] <= 1 + 1e-12);
    }
    // What moves had to: with it some way outward would be too much.
    for (std::size_t i = sum.size(); i-- > 0;) {
        if (!tree.rigid[i]) CHECK(worst[i] + motion[i] > 1);
        const double here = worst[i] + (tree.rigid[i] ? motion[i] : 0);
        if (tree.parent[i] >= 0)
            worst[std::size_t(tree.parent[i])] = std::max(worst[std::size_t(tree.parent[i])], here);
    }
    CHECK(hold_small(tree, motion, 0) == 0);
}

TEST_CASE("the estimate is twice moment over stiffness times reach") {
    // One upright rod of 2 m in a wind of 6 m/s: 0.6 rho A v^2 at its middle.
    Tree rod = make_tree::chain(1, 2, 0.03, 0.03);
    rod.stiffness[0] = Vec3(500, 400, 90);
    Scene scene;
    scene.wind = steady(6);
    const double force = 0.6 * 1.2 * (2 * 0.06) * 36;
    const auto motion = [&](const Scene& s) { return added_motion(rod, all_of(rod), s)[0] / 2; };
    // Body x is world x, y is -z: a wind along x turns it about the body's y.
    CHECK(motion(scene) == Approx(force * 1 / 400 * 2).epsilon(1e-12));
    scene.stiffness_scale = 2;
    CHECK(motion(scene) == Approx(force * 1 / 800 * 2).epsilon(1e-12));
    scene.stiffness_scale = 1;
    scene.wind->gust_factor = 1.5;
    CHECK(motion(scene) == Approx(2.25 * force / 400 * 2).epsilon(1e-12));
    scene.wind->turbulence = 0.1;
    CHECK(motion(scene) == Approx(1.8 * 1.8 * force / 400 * 2).epsilon(1e-12));
    scene.wind->grid.emplace();
    scene.wind->grid->cell = 1;
    scene.wind->grid->columns = scene.wind->grid->rows = 1;
    scene.wind->grid->velocity = {Vec3(0, 0, 3)};
    scene.wind->grid->octaves = {2};
    scene.wind->turbulence = 0;
    CHECK(motion(scene) == Approx(2.25 * force / 500 * 2).epsilon(1e-12)); // 2 x 3 m/s along z: about the body's x
    scene.wind.reset();
    Pull pull;
    pull.on.point = Vec3(0, 0, 1.5);
    pull.time = {0, 1};
    pull.force = {Vec3(0, 0, 0), Vec3(-20, 0, 0)};
    scene.pulls.push_back(pull);
    CHECK(motion(scene) == Approx(20 * 1.5 / 400 * 2).epsilon(1e-12));
    scene.wind = steady(6);
    CHECK(motion(scene) == Approx((20 * 1.5 + force) / 400 * 2).epsilon(1e-12)); // in any phase
    rod.stiffness[0].y() = 0;
    CHECK(std::isinf(motion(scene)));
}

TEST_CASE("a scene that moves nothing that is known has no estimate") {
    Scene still;
    CHECK_FALSE(no_estimate(still).empty());
    Simulate by;
    by.error = 0.01;
    CHECK_THROWS_AS(hold(make_tree::branched(), by, still), std::domain_error);
    Scene windy;
    windy.wind = steady(5);
    CHECK(no_estimate(windy).empty());
    windy.air_density = 0;
    CHECK_FALSE(no_estimate(windy).empty());
    windy.air_density = 1.2;
    windy.root_motion.resize(1);
    CHECK_THROWS_WITH(hold(make_tree::branched(), by, windy),
                      Catch::Contains("/simulate/error") && Catch::Contains("/root_motion"));
    Scene sagging;
    sagging.pose = Pose::rest;
    CHECK(no_estimate(sagging).empty());
}

TEST_CASE("holding by error holds no more than it says") {
    const Tree tree = paper_trees::branched(2e9, 0.003);
    for (const double error : {0.003, 0.01, 0.03}) {
        Scene scene;
        scene.wind = wind_preset("gusty");
        Simulate by;
        by.error = error;
        const Held held = hold(tree, by, scene);
        INFO("error " << error << ": " << text_of(held.count));
        REQUIRE((held.count.moving > 0 && held.count.error > 0));
        const RigidError found = run_both(held.tree, scene, 600);
        INFO("found " << found.worst << ", RMS " << found.rms);
        CHECK(found.worst < error);
        CHECK(found.worst > 0);
        CHECK(found.deflection > 0);
    }
}

TEST_CASE("pixels are taken at the distance of each joint") {
    const Tree tree = paper_trees::branched(2e9, 0.003);
    Scene scene;
    scene.wind = wind_preset("gusty");
    const std::vector<double> motion = added_motion(tree, all_of(tree), scene);
    const DrawnPose drawn = drawn_pose(tree);
    Simulate by;
    by.error = 3;
    by.view = Simulate::View{Vec3(0, 1, 60), 50, 1000};
    const Held far = hold(tree, by, scene);
    by.view->from = Vec3(0, 1, 6);
    const Held near = hold(tree, by, scene);
    CHECK(far.count.error > near.count.error);
    // The picture is 2 tan(25 deg) d high at a distance of d, and has 1000 pixels: what is held on the way to an end stays within 3.
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        double sum = 0;
        for (std::int64_t j = std::int64_t(i); j >= 0; j = tree.parent[std::size_t(j)]) {
            const auto k = std::size_t(j);
            const double height = 2 * std::tan(25 * std::numbers::pi / 180) * (drawn.x_w[k] - by.view->from).norm();
            if (!near.moves(k)) sum += motion[k] / height * 1000;
        }
        CHECK(sum <= 3 + 1e-9);
    }
}
