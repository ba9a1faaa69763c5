// Contacts against mechanics on paper: impulses, balls on the ground, and looking at every body.
#include "lib/free/contact.h"
#include "tests/support/free_support.h"

using namespace bough;
using namespace free_bodies;

namespace {

Capsule moved(const Capsule& c, const Vec3& d) {
    return {c.a + d, c.b + d, c.radius_a, c.radius_b};
}

} // namespace

TEST_CASE("Two capsules are as near as their nearest sampled points") {
    make_tree::Dice dice{std::mt19937(3)};
    const auto random = [&] { return Vec3(dice(-1, 1), dice(-1, 1), dice(-1, 1)); };
    for (int k = 0; k < 60; ++k) {
        Capsule p{random(), random(), 0.05, 0.05}, q{random(), random(), 0.1, 0.1};
        if (k % 4 == 1) p.b = p.a;
        if (k % 4 == 2) q.b = q.a;
        if (k % 8 == 3) q.b = q.a + 0.7 * (p.b - p.a); // parallel
        double least = 1e9;
        constexpr int n = 400;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j)
                least =
                    std::min(least, Vec3(p.a + double(i) / n * (p.b - p.a) - q.a - double(j) / n * (q.b - q.a)).norm());
        const Nearest found = nearest(p, q);
        CHECK(found.gap <= least - 0.15 + 1e-12);
        CHECK(found.gap >= least - 0.15 - 0.01);
        CHECK(found.normal.norm() == Approx(1));
    }
}

TEST_CASE("A capsule on its way meets another where their axes are their radii apart") {
    const Capsule ball{Vec3(-3, 0.1, 0), Vec3(-3, 0.1, 0), 0.1, 0.1};
    const Capsule rod{Vec3(0, 0, -1), Vec3(0, 0, 1), 0.05, 0.05};
    const Meeting m = meet(ball, moved(ball, Vec3(10, 0, 0)), rod, rod);
    REQUIRE(m.meets);
    CHECK(m.way * 10 == Approx(3 - std::sqrt(0.15 * 0.15 - 0.1 * 0.1)).epsilon(1e-5));
    CHECK_FALSE(meet(ball, moved(ball, Vec3(-10, 0, 0)), rod, rod).meets);
    CHECK_FALSE(meet(ball, moved(ball, Vec3(10, 0.6, 0)), rod, rod).meets);
    CHECK_FALSE(meet(ball, moved(ball, Vec3(2.5, 0, 0)), rod, rod).meets);
    CHECK(meet({rod.a, rod.b, 0.1, 0.1}, moved({rod.a, rod.b, 0.1, 0.1}, Vec3(1, 0, 0)), rod, rod).way == 0);
    // What slides along a hundredth of a millimetre beside it does not touch it.
    const Capsule beside = moved(rod, Vec3(rod.radius_a + rod.radius_b + 1e-5, 0, 0));
    CHECK_FALSE(meet(beside, moved(beside, Vec3(0, 1, 1)), rod, rod).meets);
}

TEST_CASE("A ball on the ground bounces back with its restitution, and rests at its radius") {
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.contact->ground = true;
    scene.contact->ground_height = -0.5;
    const double e = GENERATE(0.0, 0.5, 1.0);
    scene.contact->restitution = e;
    scene.balls = {ball(Vec3(3, 1, 0), Vec3(1, 0, 0))};
    FreeRun<> run(hinged_rod(), scene, ways[0], 1.0 / 300);
    double before = 0, after = 0;
    for (int k = 0; k < 3000 && after <= 0; ++k) {
        before = run.ball().motion.v.y();
        run.steps(1);
        if (before < 0 && run.ball().motion.v.y() >= 0) after = std::max(run.ball().motion.v.y(), 1e-12);
    }
    CHECK(after == Approx(-e * (before - 9.81 / 300)).margin(1e-9));
    CHECK(run.ball().motion.v.x() == Approx(1)); // no friction
    if (e > 0.5) return;
    run.steps(3000);
    CHECK(run.ball().motion.x.y() == Approx(-0.5 + 0.1).margin(2e-3));
}

TEST_CASE("A sliding ball is braked by friction until it rolls with 5/7 of its speed") {
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.contact->ground = true;
    scene.contact->friction = 0.3;
    scene.balls = {ball(Vec3(3, 0.1, 0), Vec3(5, 0, 0))};
    FreeRun<> run(hinged_rod(), scene, ways[0], 1.0 / 120);
    run.steps(12);
    CHECK(run.ball().motion.v.x() == Approx(5 - 0.3 * 9.81 * 0.1).epsilon(1e-3));
    CHECK(run.ball().motion.omega.z() == Approx(-0.3 * 9.81 * 0.1 * 0.1 / (0.4 * 0.01)).epsilon(1e-3));
    run.steps(240);
    CHECK(run.ball().motion.v.x() == Approx(5 * 5.0 / 7).epsilon(1e-3));
    CHECK(run.ball().motion.omega.z() * 0.1 == Approx(-5 * 5.0 / 7).epsilon(1e-3));
}

TEST_CASE("A ball against a hinged rod: the impulse formula, and the moment about the hinge kept") {
    const Way way = GENERATE(from_range(ways));
    INFO(name(way));
    const double e = GENERATE(0.0, 0.6);
    const double arm = 1.5, speed = 3;
    Scene scene = empty_scene();
    scene.joint_inertia = JointInertia::paper;
    scene.contact->restitution = e;
    scene.balls = {ball(Vec3(0, 0.14, arm), Vec3(0, -speed, 0), 0.1, 0.7)};
    FreeRun<> run(hinged_rod(), scene, way);
    const Mat3 com = cross_matrix(run.tree.com[0]);
    const double inertia = Mat3(run.tree.inertia[0] - run.tree.mass[0] * com * com)(0, 0);
    run.steps(1);
    CHECK(run.world.events.what == std::vector<std::string>{"hit"});
    CHECK(run.world.counts.hits == 1);
    const double impulse = (1 + e) * speed / (1 / 0.7 + arm * arm / inertia);
    CHECK(run.ball().motion.v.y() == Approx(-speed + impulse / 0.7).epsilon(1e-9));
    run.steps(1); // in which the rod answers
    TreePoses<double> poses;
    poses.begin(run.plan, run.state);
    CHECK(poses.of(0).omega.norm() == Approx(impulse * arm / inertia).epsilon(1e-6));
    CHECK(poses.of(0).omega.x() > 0); // downward at positive z
    CHECK(run.world.events.value[0] == Approx(impulse));
}

TEST_CASE("What the trees take is what the balls lose") {
    const Way way = GENERATE(from_range(ways));
    Scene scene = empty_scene();
    scene.contact->friction = 0.4;
    scene.contact->restitution = 0.3;
    for (int k = 0; k < 3; ++k)
        scene.balls.push_back(ball(Vec3(0.05 * k, 0.14, 0.5 + 0.3 * k), Vec3(1, -2 - k, 0.5), 0.1, 1 + k));
    FreeRun<> run(hinged_rod(), scene, way);
    Vec3 before = Vec3::Zero(), after = Vec3::Zero(), given = Vec3::Zero();
    for (const FreeBody& free : run.world.free) before += free.mass * free.motion.v;
    run.steps(1);
    for (const FreeBody& free : run.world.free) after += free.mass * free.motion.v;
    REQUIRE(run.state.loads.size() >= 2);
    for (const Load<double>& load : run.state.loads) given += run.plan.dt * load.force;
    CHECK((before - after - given).norm() < 1e-12);
}

TEST_CASE("A ball at 10 m/s never gets through a branch 5 cm thick at 30 frames a second") {
    const Way way = GENERATE(ways[0], ways[3]);
    const double speed = GENERATE(10.0, 100.0);
    Tree tree = make_tree::chain(1, 2, 0.025, 0.025);
    tree.joint_rotation[0] = Quat::Identity();
    for (const double radius : {0.01, 0.1})
        for (int k = 0; k < 40; ++k) {
            Scene scene = empty_scene();
            const double start = 0.2 + 0.0251 * k; // at which part of a step it comes
            scene.balls = {ball(Vec3(0.01 * (k % 3), start, 1.2), Vec3(0, -speed, 0), radius, 0.2)};
            FreeRun<> run(tree, scene, way);
            INFO(radius << " " << k);
            TreePoses<double> poses;
            double beside = 1, aside = 0;
            for (int step = 0; step < 12; ++step) {
                run.steps(1);
                poses.begin(run.plan, run.state);
                const BodyPose pose = poses.of(0);
                const Vec3 at = pose.R.transpose() * (run.ball().motion.x - pose.x);
                if (beside > 0 && at.y() <= 0) aside = std::abs(at.x()) / (radius + 0.025);
                beside = at.y();
            }
            // Head on it stays above; what comes a centimetre off its middle may slide off, and then has gone round.
            if (k % 3 == 0)
                CHECK(beside > 0);
            else if (beside <= 0)
                CHECK(aside > 0.7);
            CHECK(run.world.counts.hits >= 1);
        }
}

TEST_CASE("Neither pruning by reach nor looking for all at once changes what is met") {
    const Tree tree = make_tree::random_tree(600, 4);
    const int balls = GENERATE(2, 40); // along the tree; all at once
    INFO(balls << " balls");
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.contact->ground = true;
    scene.contact->friction = 0.5;
    scene.contact->restitution = 0.4;
    scene.contact->leaves = true;
    make_tree::Dice dice{std::mt19937(9)};
    for (int k = 0; k < balls; ++k)
        scene.balls.push_back(
            ball(Vec3(dice(-1, 1), dice(0.5, 3), dice(-1, 1)), Vec3(dice(-3, 3), dice(-6, 0), dice(-3, 3)), 0.03, 0.1));
    const Way way = GENERATE(ways[0], ways[1], ways[3]);
    INFO(name(way));
    FreeRun<> pruned(tree, scene, way), all(tree, scene, way);
    all.world.brute_force = true;
    for (int k = 0; k < 40; ++k) {
        pruned.steps(1);
        all.steps(1);
        REQUIRE(pruned.hash() == all.hash());
        CHECK(pruned.world.many == (balls > 2));
    }
    CHECK(pruned.world.counts.hits > std::uint64_t(balls) / 2);
    CHECK(pruned.world.counts.tests.bodies < all.world.counts.tests.bodies / 4);
}

TEST_CASE("The paper's pair: a penalty on the tree, the tree's velocity for the ball, and what that leaves open") {
    Scene scene = empty_scene();
    scene.joint_inertia = JointInertia::paper;
    scene.contact->model = ContactModel::penalty;
    scene.contact->penalty = 2;
    scene.balls = {ball(Vec3(0, 0.14, 1.5), Vec3(0, -3, 0), 0.1, 0.7)};
    const Way way = GENERATE(from_range(ways));
    FreeRun<> run(hinged_rod(), scene, way);
    const Mat3 com = cross_matrix(run.tree.com[0]);
    const double inertia = Mat3(run.tree.inertia[0] - run.tree.mass[0] * com * com)(0, 0);
    run.steps(1);
    const double on_tree = 2 * 3 * run.plan.dt;
    CHECK(run.ball().motion.v.y() == Approx(0).margin(1e-12)); // as the rod's
    CHECK(run.world.counts.imbalance == Approx(0.7 * 3 - on_tree).epsilon(1e-9));
    run.steps(1);
    TreePoses<double> poses;
    poses.begin(run.plan, run.state);
    CHECK(poses.of(0).omega.x() == Approx(on_tree * 1.5 / inertia).epsilon(1e-6));
}

TEST_CASE("Contacts of many balls with a tree give no energy, however heavy they are") {
    const Way way = GENERATE(ways[0], ways[1]);
    const double mass = GENERATE(0.01, 1e6);
    const Tree tree = make_tree::branched();
    Scene scene = empty_scene();
    scene.contact->friction = 0.3;
    make_tree::Dice dice{std::mt19937(2)};
    for (int k = 0; k < 30; ++k)
        scene.balls.push_back(ball(Vec3(dice(-0.5, 0.5), dice(0, 2), dice(-0.5, 0.5)),
                                   Vec3(dice(-3, 3), dice(-3, 3), dice(-3, 3)), 0.05, mass));
    FreeRun<> run(tree, scene, way);
    const auto of_balls = [&] {
        double sum = 0;
        for (const FreeBody& free : run.world.free)
            sum +=
                free.mass * free.motion.v.squaredNorm() / 2 + free.inertia(0, 0) * free.motion.omega.squaredNorm() / 2;
        return sum;
    };
    const auto of_tree = [&] {
        TreePoses<double> poses;
        poses.begin(run.plan, run.state);
        double sum = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            const BodyPose pose = poses.of(i);
            const Vec3 v = pose.velocity_at(pose.at(tree.com[i])), w = pose.R.transpose() * pose.omega,
                       a = poses.theta(i);
            sum += tree.mass[i] * v.squaredNorm() / 2 + w.dot(tree.inertia[i] * w) / 2 +
                   a.dot(tree.stiffness[i].cwiseProduct(a)) / 2;
        }
        return sum;
    };
    const double start = of_balls();
    for (int k = 0; k < 60; ++k) {
        run.steps(1);
        REQUIRE(!first_non_finite(run.world));
        REQUIRE(of_balls() + of_tree() <= 1.01 * start);
    }
    CHECK(run.world.counts.hits > 0);
}

TEST_CASE("A ball against an undamped sprung rod: what a step of the rod's own period can add is bounded") {
    // Springs whose period a step hardly resolves, h^2 K / I of 0.01 to 1000 (5 Hz is 1), balls of 1/100 to 100 times the rod's mass: at most this
    // factor of the start's energy, in all 3 s. The instant at which one has the impulse and the other not yet counts.
    const Way way = GENERATE(ways[0], ways[2]);
    const double restitution = GENERATE(0.0, 0.2);
    const double most_allowed = way.solver == Solver::coupled ? 1.3 : 3;
    INFO(name(way));
    double most = 0;
    for (const double stiffness : {0.01, 1.0, 3.0, 10.0, 100.0, 1000.0})
        for (const double ratio : {0.01, 1.0, 10.0, 100.0}) {
            Tree tree = make_tree::chain(1, 2, 0.025, 0.025);
            tree.joint_rotation[0] = Quat::Identity();
            const double I = tree.inertia[0](0, 0) + tree.mass[0] * tree.com[0].squaredNorm();
            tree.stiffness[0] = Vec3::Constant(stiffness * I * 900);
            tree.damping[0] = 0;
            Scene scene = empty_scene();
            scene.contact->restitution = restitution;
            scene.joint_inertia = JointInertia::paper;
            scene.balls = {ball(Vec3(0, 0.14, 1.5), Vec3(0, -3, 0), 0.1, ratio * I / 2.25)};
            FreeRun<> run(tree, scene, way);
            const double start = 4.5 * scene.balls[0].mass;
            TreePoses<double> poses;
            for (int k = 0; k < 90; ++k) {
                run.steps(1);
                poses.begin(run.plan, run.state);
                const BodyPose pose = poses.of(0);
                const Vec3 v = pose.velocity_at(pose.at(tree.com[0])), w = pose.R.transpose() * pose.omega,
                           a = poses.theta(0);
                const FreeBody& free = run.ball();
                const double energy = tree.mass[0] * v.squaredNorm() / 2 + w.dot(tree.inertia[0] * w) / 2 +
                                      a.dot(tree.stiffness[0].cwiseProduct(a)) / 2 +
                                      free.mass * free.motion.v.squaredNorm() / 2 +
                                      free.motion.omega.dot(free.inertia * free.motion.omega) / 2;
                most = std::max(most, energy / start);
            }
        }
    CHECK(most < most_allowed);
    CHECK(most > 0.9);
}

TEST_CASE("A stick that falls comes to rest on the ground, and not in it") {
    const double lean = GENERATE(0.05, 0.3, 0.8);
    Tree tree = make_tree::chain(1, 2, 0.03, 0.02);
    tree.joint_rotation[0] = make_tree::turn(lean, Vec3::UnitX());
    tree.joint_position[0] = Vec3(0, 1, 0);
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.contact->ground = true;
    scene.contact->friction = 0.5;
    scene.fracture = Fracture();
    scene.fracture->branch = 0;
    Pull pull; // a threshold of 0 is passed by what is bent
    pull.time = {0, 0.1};
    pull.force = {Vec3(0.1, 0, 0), Vec3(0.1, 0, 0)};
    scene.pulls = {pull};
    FreeRun<> run(tree, scene, ways[0]);
    run.steps(450); // 15 s
    REQUIRE(run.world.free.size() == 1);
    const FreeBody& stick = run.world.free[0];
    CHECK(stick.at_rest);
    CHECK(stick.motion.x.y() > 0.0);
    CHECK(stick.motion.x.y() < 0.05);
}

TEST_CASE("A ball that rolls comes to rest after v^2 / 2 a, a = c g / (1 + I / m r^2)") {
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.contact->ground = true;
    scene.contact->friction = 0.8;
    scene.contact->rolling = GENERATE(0.03, 0.1);
    const double r = 0.1, v = 2;
    scene.balls = {ball(Vec3(3, r, 0), Vec3(v, 0, 0), r)};
    scene.balls[0].angular_velocity = Vec3(0, 0, -v / r);
    FreeRun<> run(hinged_rod(), scene, ways[0], 1.0 / 240);
    run.steps(240 * 12);
    CHECK(run.ball().at_rest);
    const double a = scene.contact->rolling * 9.81 / 1.4;
    CHECK(run.ball().motion.x.x() - 3 == Approx(v * v / (2 * a)).epsilon(0.02));
}

TEST_CASE("A fallen tree against a tree costs about its bodies, not the product of both, and meets what looking at all "
          "does") {
    const auto felled = [](int bodies) {
        const double radius = 1.0 / bodies; // a quarter of a body's length
        const make_tree::Wood stiff{900, 9e13, 6e12, 0.01};
        Tree stands = make_tree::chain(bodies, 4, radius, radius, 0, stiff), falls = stands;
        stands.joint_rotation[0] = falls.joint_rotation[0] = Quat::Identity(); // along the world's z
        falls.joint_position[0] = Vec3(radius / 3, 2.2 * radius, 0);
        return make_tree::forest({stands, falls});
    };
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.contact->friction = 0.5;
    scene.fracture = Fracture();
    scene.fracture->joints.resize(1);
    const Way way = GENERATE(ways[0], ways[1]);
    INFO(name(way));
    const auto tests_of = [&](int bodies, bool brute_force) {
        const Tree tree = felled(bodies);
        Scene own = scene;
        own.fracture->joints[0].on.body = bodies;
        own.fracture->joints[0].torque = 0;
        FreeRun<> run(tree, own, way);
        run.world.brute_force = brute_force;
        run.steps(20);
        REQUIRE(run.world.free.size() == 1);
        REQUIRE(run.world.free[0].parts.size() == std::size_t(bodies));
        CHECK(run.world.counts.impulse > 0.1 * run.world.free[0].mass);
        return std::pair(run.world.counts.tests.pairs, run.hash());
    };
    const auto few = tests_of(40, false), many = tests_of(160, false), all = tests_of(40, true);
    CHECK(few.second == all.second);
    CHECK(many.first < 6 * few.first); // the product grows by 16
}
