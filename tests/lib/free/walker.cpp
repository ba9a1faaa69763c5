// A walker against mechanics on paper: momentum, a parabola, a lever.
#include "lib/free/walker.h"
#include "tests/support/free_support.h"

using namespace bough;
using namespace free_bodies;

namespace {

const Vec3 down(0, -9.81, 0);

// Two trees, three metres apart: trunks of two pieces, a level branch each, toward the other.
Tree two_trees() {
    const make_tree::Wood wood;
    Tree tree;
    for (int k = 0; k < 2; ++k) {
        const auto first = std::int32_t(tree.size_bodies());
        make_tree::add_piece(tree, -1, Vec3(3.0 * k, 0, 0), make_tree::upright(), 1, 0.1, 0.09, 2 * k, 0, 0, wood);
        make_tree::add_piece(tree, first, Vec3(0, 0, 1), Quat::Identity(), 1, 0.09, 0.08, 2 * k, 0, 0.5, wood);
        // Body axes of an upright trunk: z up. A quarter turn about y lays the branch along x or against it.
        make_tree::add_piece(tree, first + 1, Vec3(0, 0, 0.5),
                             make_tree::turn((k == 0 ? 1 : -1) * 1.5707963267948966, Vec3::UnitY()), 1, 0.04, 0.03,
                             2 * k + 1, 1, 0, wood);
    }
    return tree;
}

Walker::Stop on(std::int64_t body, double z, double time, bool leap = false) {
    Walker::Stop stop;
    stop.on.body = body;
    stop.on.point = Vec3(0, 0, z);
    stop.time = time;
    stop.leap = leap;
    return stop;
}

Walk walk_of(const Tree& tree, const Walker& walker) {
    return make_walk(tree, {{0, tree.size_bodies(), 0}}, walker, down, "/walkers/0");
}

Walker squirrel(std::vector<Walker::Stop> stops) {
    Walker walker;
    walker.stops = std::move(stops);
    return walker;
}

Vec3 impulse(const Walk& walk, double from, double to, double h) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; from + k * h < to - h / 2; ++k)
        if (const auto load = walker_load(walk, from + k * h, h)) sum += h * load->force;
    return sum;
}

} // namespace

TEST_CASE("over a walk with corners and a leap the trees give what gravity takes, at any step") {
    const Tree tree = two_trees();
    const Walk walk = walk_of(tree, squirrel({on(0, 0.2, 0), on(2, 0.9, 1.5), on(5, 0.8, 2.5), on(3, 0.1, 4)}));
    for (const double h : {1.0 / 30, 1.0 / 300, 0.1}) {
        // From 0.1 s on, when all of its weight is there, and it is at rest again at the end; the walk from 0 has begun by then.
        const Vec3 begun = 0.4 * walker_velocity(walk, 0.1);
        CHECK((impulse(walk, 0.1, 4.1, h) - (0.4 * 4.0 * down + begun)).norm() < 1e-9);
    }
    CHECK_FALSE(walker_load(walk, -1, 0.5));
    // A leap at once takes all of its recoil, though the weight is still being set down.
    Walker light = squirrel({on(2, 0.9, 0), on(5, 0.7, 1)});
    light.push = 0.5 - 1e-3;
    const Walk leaps = make_walk(tree, {{0, tree.size_bodies(), 0}}, light, Vec3::Zero(), "");
    CHECK((impulse(leaps, 0, 0.499, 0.499 / 64) + 0.4 * leaps.legs[0].leave).norm() <
          1e-9 * leaps.legs[0].leave.norm());
}

TEST_CASE("a walk goes through the body that carries both ends, at rest at both") {
    const Tree tree = two_trees();
    const Walk walk = walk_of(tree, squirrel({on(0, 0.2, 1), on(2, 0.9, 3)}));
    REQUIRE(walk.legs.size() == 1);
    CHECK(walk.legs[0].length == Approx(0.8 + 0.5 + 0.9));
    CHECK(walker_place(walk, 0).body == 0);
    const WalkerPlace half = walker_place(walk, 2); // by symmetry
    CHECK(half.body == 1);
    CHECK(half.point_b.z() == Approx(1.1 - 0.8));
    CHECK(walker_place(walk, 9).point_b.z() == Approx(0.9));
    CHECK(walker_velocity(walk, 1).isZero(0));
    CHECK(walker_velocity(walk, 3).isZero(0));
    const double h = 1e-5; // the way's slope
    const WalkerPlace before = walker_place(walk, 2.7 - h), after = walker_place(walk, 2.7 + h);
    REQUIRE(before.body == 2);
    CHECK(walker_velocity(walk, 2.7).x() == Approx((after.point_b.z() - before.point_b.z()) / (2 * h)).epsilon(1e-6));
}

TEST_CASE("a leap is the parabola between its ends") {
    const Tree tree = two_trees();
    const Walker walker = squirrel({on(2, 0.9, 0), on(5, 0.7, 0.8)});
    const Walk walk = walk_of(tree, walker);
    const Vec3 from(0.9, 1.5, 0), to(3 - 0.7, 1.5, 0);
    const double flight = 0.6;
    CHECK((walk.legs[0].leave - Vec3(1.4 / flight, 9.81 * flight / 2, 0)).norm() < 1e-12);
    const WalkerPlace top = walker_place(walk, 0.4);
    CHECK(top.part == Approx(0.5));
    CHECK(top.bow.y() == Approx(9.81 * flight * flight / 8));
    CHECK((walker_velocity(walk, 0.4) - Vec3(1.4 / flight, 0, 0)).norm() < 1e-12);
    CHECK_FALSE(walker_load(walk, 0.3, 0.1));
    // A step that the landing falls into: on what it comes to.
    CHECK(walker_load(walk, 0.65, 0.1)->body == 5);
    const Vec3 met = from + (to - from) * top.part + top.bow;
    CHECK(met.y() > 1.5);
    // It is a leap also where wood leads, if the stop says so; and where none leads.
    CHECK(walk_of(tree, squirrel({on(0, 0.2, 0), on(1, 0.9, 1, true)})).legs[0].leap);
    CHECK_THROWS_WITH(walk_of(tree, squirrel({on(2, 0.9, 0), on(5, 0.7, 0.2)})), Catch::Contains("/stops/1/time"));
}

TEST_CASE("who stands on a level branch bends it by the weight's lever, on both steps and paths") {
    Tree tree = two_trees();
    tree.damping.assign(tree.size_bodies(), 0.05);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (i % 3 != 2) tree.stiffness[i] *= 1e6; // the branches alone bend
    Scene scene = empty_scene();
    scene.contact.reset();
    scene.pose = Pose::rest;
    scene.gravity = Vec3(0, -0.01, 0); // the trees' own weight would bend them too
    scene.walkers = {squirrel({on(2, 0.2, 0), on(2, 0.9, 1)})};
    scene.walkers[0].mass = 400;
    const Way way = GENERATE(from_range(ways));
    CAPTURE(name(way));
    scene.pose = Pose::drawn;
    FreeRun<> run(tree, scene, way);
    const Vec3 start = run.plan.theta_start[2];
    run.steps(900);
    present(run.plan, run.state);
    // Moment of the weight about the joint, of the branch turned by phi: F L cos(phi) = K phi, on top of what it hangs by.
    const double K = tree.stiffness[2].x(), F = 400 * 0.01, L = 0.9;
    double phi = 0;
    for (int k = 0; k < 50; ++k) phi = F * L * std::cos(phi) / K;
    CHECK((run.state.theta[2] - start).norm() == Approx(phi).epsilon(2e-4));
    CHECK((run.state.theta[5] - run.plan.theta_start[5]).norm() < 1e-12); // the other tree
    CHECK(run.state.calls[std::size_t(Stage::walkers)] == 900);
}

TEST_CASE("walkers and what may break are refused together, and so is a walker of one stop nowhere") {
    const Tree tree = two_trees();
    Scene scene = empty_scene();
    scene.walkers = {squirrel({on(2, 0.2, 0), on(2, 0.9, 1)})};
    scene.fracture.emplace();
    CHECK_THROWS_WITH(FreeRun<>(tree, scene, ways[0]), Catch::Contains("/fracture"));
    scene.fracture.reset();
    scene.walkers[0].stops[1].on.body = 6;
    CHECK_THROWS_WITH(FreeRun<>(tree, scene, ways[0]), Catch::Contains("/walkers/0/stops/1/on"));
}

TEST_CASE("a leap's two events are noted in the steps they fall into, also one that begins with the run") {
    const Tree tree = two_trees();
    Scene scene = empty_scene();
    scene.contact.reset();
    for (const double push : {0.0, 0.1}) {
        CAPTURE(push);
        scene.walkers = {squirrel({on(2, 0.9, 0), on(5, 0.9, 1, true)})};
        scene.walkers[0].push = push;
        FreeRun<> run(tree, scene, ways[0]);
        std::vector<double> leapt, landed;
        for (int k = 0; k < 60; ++k) {
            const std::size_t before = run.world.events.what.size();
            run.steps(1);
            for (std::size_t e = before; e < run.world.events.what.size(); ++e)
                (run.world.events.what[e] == "leapt" ? leapt : landed).push_back((k + 1) / 30.0);
        }
        REQUIRE(leapt.size() == 1);
        REQUIRE(landed.size() == 1);
        CHECK(leapt[0] == Approx(std::max(1.0, std::ceil(push * 30)) / 30));
        CHECK(landed[0] == Approx(std::ceil((1 - push) * 30 - 1e-9) / 30));
    }
}
