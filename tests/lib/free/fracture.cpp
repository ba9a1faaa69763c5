// Fracture against statics and momentum, and what is left of a tree against a tree that never had the rest.
#include "lib/free/fracture.h"
#include "tests/support/free_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace free_bodies;

namespace {

// A stiff post with an arm to the side that bears a fruit on a soft stalk.
Tree fruit_tree() {
    Tree t = make_tree::chain(3, 1.5, 0.03, 0.02);
    make_tree::add_piece(t, 2, {0, 0, 0.5}, make_tree::turn(std::numbers::pi / 2, Vec3::UnitY()), 0.5, 0.01, 0.008, 1,
                         1, 0);
    make_tree::add_fruit(t, 3, {0, 0, 0.4}, make_tree::turn(0.4, Vec3::UnitX()), 0.06, 0.03, 1, 1, 0.8);
    return t;
}

Scene still(Pose pose = Pose::drawn) {
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.pose = pose;
    scene.contact->trees = false;
    return scene;
}

struct Momentum {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero(); // about the world's origin
    void add(double m, const Vec3& c, const Vec3& v, const Vec3& spin) {
        linear += m * v;
        angular += m * c.cross(v) + spin;
    }
};

template <class T> Momentum momentum(const FreeRun<T>& run) {
    Momentum sum;
    TreePoses<T> poses;
    poses.begin(run.plan, run.state);
    for (std::size_t i = 0; i < run.tree.size_bodies(); ++i) {
        if (run.plan.mass[i] == 0) continue;
        const BodyPose pose = poses.of(i);
        const Vec3 c = pose.at(run.tree.com[i]);
        sum.add(run.tree.mass[i], c, pose.velocity_at(c),
                pose.R * run.tree.inertia[i] * pose.R.transpose() * pose.omega);
    }
    for (const FreeBody& free : run.world.free) {
        const Mat3 R = free.motion.q.toRotationMatrix();
        sum.add(free.mass, free.motion.x, free.motion.v, R * free.inertia * R.transpose() * free.motion.omega);
    }
    return sum;
}

} // namespace

TEST_CASE("A fruit breaks off at the moment that its weight has about the joint, and not below") {
    const Way way = GENERATE(from_range(ways));
    INFO(name(way));
    const Tree tree = fruit_tree();
    Scene scene = still();
    {
        TreePoses<double> poses; // the fruit's lever in the drawn pose
        FreeRun<> run(tree, scene, way);
        poses.begin(run.plan, run.state);
        const BodyPose pose = poses.of(4);
        const Vec3 lever = pose.R * tree.com[4];
        const double torque = tree.mass[4] * 9.81 * std::hypot(lever.x(), lever.z());
        CHECK(torque > 0);
        scene.fracture = Fracture();
        for (const double factor : {0.999, 1.001}) {
            scene.fracture->fruit = factor * torque;
            FreeRun<> with(tree, scene, way);
            with.steps(3);
            CHECK(with.world.free.size() == (factor < 1 ? 1 : 0));
            if (factor > 1) continue;
            CHECK(with.world.events.what.front() == "broke");
            CHECK(with.world.events.body.front() == 4);
            CHECK(with.world.events.value.front() == Approx(torque).epsilon(1e-6));
        }
    }
}

TEST_CASE("Momentum is kept at the moment of breaking, linear and angular, of single bodies and of subtrees") {
    const Way way = GENERATE(from_range(ways));
    INFO(name(way));
    const Tree tree = make_tree::branched();
    Scene scene = empty_scene();
    scene.contact->trees = false;
    Pull pull;
    pull.on.body = 5;
    pull.time = {0, 0.3};
    pull.force = {Vec3(30, 10, -20), Vec3(30, 10, -20)};
    scene.pulls = {pull};
    scene.fracture = Fracture();
    FreeRun<> run(tree, scene, way);
    run.steps(5);
    REQUIRE(run.world.free.empty());
    const Momentum before = momentum(run);
    REQUIRE(before.linear.norm() > 1e-6);
    // A branch with its twig and leaf, and, within it, the twig's own leaf.
    const std::vector<std::uint32_t> joints{4, 11};
    run.world.poses.begin(run.plan, run.state);
    run.world.free = pieces_of(run.plan, run.tree, run.world.subtrees, run.world.poses, joints);
    detach(run.plan, run.state, run.world.subtrees, joints, run.world.remaining);
    CHECK(run.world.free[0].parts.size() == 4); // 4, 5, 9, 10
    CHECK(run.world.free[1].parts.size() == 1);
    const Momentum after = momentum(run);
    CHECK((after.linear - before.linear).norm() < 1e-11 * before.linear.norm());
    CHECK((after.angular - before.angular).norm() < 1e-11 * before.angular.norm());
    double mass = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        mass += i == 4 || i == 5 || i == 9 || i == 10 || i == 11 ? 0 : tree.mass[i];
    CHECK(run.plan.c_mass[0] == Approx(mass).epsilon(1e-14));
}

TEST_CASE("What is left moves as a tree does that never had what fell") {
    const Way way = GENERATE(from_range(ways));
    INFO(name(way));
    const bool windy = GENERATE(false, true);
    const Tree tree = make_tree::branched();
    // The same without its twig (9), the twig's leaf (11) and the fruit (13).
    Tree pruned = tree;
    const std::vector<std::size_t> gone{13, 11, 9};
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (std::find(gone.begin(), gone.end(), i) == gone.end()) kept.push_back(i);
    for (const std::size_t i : gone) {
        const auto drop = [&](auto& array) { array.erase(array.begin() + std::ptrdiff_t(i)); };
        drop(pruned.parent), drop(pruned.kind), drop(pruned.mass), drop(pruned.com), drop(pruned.inertia);
        drop(pruned.joint_position), drop(pruned.joint_rotation), drop(pruned.stiffness), drop(pruned.damping);
        drop(pruned.size), drop(pruned.branch), drop(pruned.level), drop(pruned.s);
        for (std::int32_t& p : pruned.parent) p -= p > std::int32_t(i);
    }
    REQUIRE(!check(pruned));
    Scene scene = still(Pose::rest);
    scene.joint_inertia = JointInertia::paper;                                    // its factors are of the whole tree
    if (windy && way.solver == Solver::coupled) scene.wind = simulate::steady(6); // analytic: weights of the whole tree
    FreeRun<> bare(pruned, scene, way);
    scene.fracture = Fracture();
    scene.fracture->joints = {{{Selector::By::body, 0, 9, {}}, 0}, {{Selector::By::body, 0, 13, {}}, 0}};
    FreeRun<> broken(tree, scene, way);
    const std::vector<std::uint32_t> joints{9, 13};
    detach(broken.plan, broken.state, broken.world.subtrees, joints, broken.world.remaining);
    broken.world.breakable.clear();
    for (int k = 0; k < 60; ++k) {
        bare.steps(1);
        broken.steps(1);
    }
    TreePoses<double> a, b;
    a.begin(bare.plan, bare.state);
    b.begin(broken.plan, broken.state);
    // Gravity's row bound of the analytic step is of the whole tree: it lags by another part of second order.
    const double tolerance = way.solver == Solver::coupled ? 1e-9 : 2e-3;
    double most = 0;
    for (std::size_t k = 0; k < kept.size(); ++k) most = std::max(most, b.theta(kept[k]).norm());
    REQUIRE(most > 1e-4);
    for (std::size_t k = 0; k < kept.size(); ++k) CHECK((a.theta(k) - b.theta(kept[k])).norm() < tolerance * most);
    for (const std::size_t i : gone) CHECK(b.theta(i).isZero(0));
}

TEST_CASE("A free piece keeps its angular momentum, and its centre of mass flies a parabola") {
    const Tree tree = make_tree::branched();
    Scene scene = still(Pose::rest);
    scene.fracture = Fracture();
    scene.fracture->joints = {{{Selector::By::body, 0, 4, {}}, 0.0}};
    FreeRun<> run(tree, scene, ways[0]);
    run.steps(1);
    REQUIRE(run.world.free.size() == 1);
    FreeBody& free = run.world.free[0];
    free.motion.omega = Vec3(3, -2, 5);
    const FreeMotion start = free.motion;
    const auto spin = [&] {
        const Mat3 R = free.motion.q.toRotationMatrix();
        return Vec3(R * free.inertia * R.transpose() * free.motion.omega);
    };
    const Vec3 before = spin();
    const double twice_energy = before.dot(free.motion.omega);
    run.steps(60);
    CHECK((spin() - before).norm() < 1e-11 * before.norm());
    CHECK(std::abs(spin().dot(free.motion.omega) - twice_energy) < 0.02 * twice_energy);
    const double t = 2, h = 1.0 / 30; // x after n steps of v += g h, x += v h
    const Vec3 place = start.x + t * start.v + Vec3(0, -9.81, 0) * (t * t + t * h) / 2;
    CHECK((free.motion.x - place).norm() < 1e-11);
}

TEST_CASE("Everything may break in one step: every body is free, nothing is left") {
    const Way way = GENERATE(from_range(ways));
    const Tree tree = make_tree::random_tree(80, 2);
    Scene scene = still(Pose::rest);
    scene.contact->ground = true;
    scene.contact->trees = true;
    scene.fracture = Fracture();
    scene.fracture->branch = scene.fracture->leaf = scene.fracture->petal = scene.fracture->fruit = 0;
    FreeRun<> run(tree, scene, way);
    run.steps(2);
    CHECK(run.world.free.size() == 80);
    CHECK(run.world.breakable.empty());
    for (std::size_t i = 0; i < 80; ++i) CHECK(run.plan.mass[i] == 0);
    run.steps(100);
    CHECK(!first_non_finite(run.world));
    for (const FreeBody& free : run.world.free) {
        CHECK(free.motion.x.y() < 1.0);
        CHECK(free.motion.x.y() > -0.05);
        CHECK(free.motion.v.norm() < 5);
    }
}

TEST_CASE("Thresholds: infinite never, by kind, by strength of the section, by single joints, spread by the seed") {
    const Tree tree = make_tree::branched();
    const std::vector<TreeRange> ranges{{0, tree.size_bodies(), 0}};
    Fracture f;
    CHECK(breakable_joints(tree, ranges, f).empty());
    f.leaf = 0.1;
    CHECK(breakable_joints(tree, ranges, f).size() == 3);
    f.strength = 4e7;
    f.joints = {{{Selector::By::body, 0, 13, {}}, 0.7}, {{Selector::By::body, 0, 10, {}}, 0.2}};
    const std::vector<Breakable> joints = breakable_joints(tree, ranges, f);
    CHECK(joints.size() == tree.size_bodies());
    for (const Breakable& joint : joints) {
        const double r = tree.size[joint.body][1];
        const double expected = joint.body == 13                        ? 0.7
                                : joint.body == 10                      ? 0.2
                                : tree.kind[joint.body] == Kind::branch ? 4e7 * std::numbers::pi / 4 * r * r * r
                                                                        : 0.1;
        CHECK(joint.torque == Approx(expected));
    }
    // Spread: logarithms of many thresholds have its standard deviation.
    Tree many = make_tree::random_tree(4000, 5);
    Fracture spread;
    spread.branch = spread.leaf = spread.fruit = 2;
    spread.spread = 0.3;
    double sum = 0, squares = 0;
    for (const Breakable& joint : breakable_joints(many, {{0, 4000, 0}}, spread)) {
        const double z = std::log(joint.torque / 2);
        sum += z;
        squares += z * z;
    }
    CHECK(std::abs(sum / 4000) < 0.02);
    CHECK(std::sqrt(squares / 4000) == Approx(0.3).epsilon(0.05));
    const auto first = breakable_joints(many, {{0, 4000, 0}}, spread);
    spread.seed = 2;
    CHECK(first[7].torque != breakable_joints(many, {{0, 4000, 0}}, spread)[7].torque);
}

TEST_CASE("Lanes and plain path break the same joints, and fall alike") {
    const Solver solver = GENERATE(Solver::coupled, Solver::analytic);
    const Tree tree = make_tree::random_tree(150, 8);
    FreeRun<> plain(tree, lively(), {solver, std::nullopt}), lanes(tree, lively(), {solver, fast::Target::baseline});
    plain.steps(2); // before rounding grows: leaves that turn over in a storm are chaotic
    lanes.steps(2);
    CHECK(plain.world.broken.size() > 5);
    REQUIRE(plain.world.broken == lanes.world.broken);
    for (std::size_t k = 0; k < plain.world.free.size(); ++k) {
        const FreeBody &a = plain.world.free[k], &b = lanes.world.free[k];
        INFO(k << ", body " << a.parts.front().body << ", " << a.parts.size() << " parts, " << solver_name(solver));
        CHECK((a.motion.x - b.motion.x).norm() < 1e-6);
    }
}

TEST_CASE("What a ball gave a branch that breaks in the same step goes with the branch") {
    const Way way = GENERATE(from_range(ways));
    INFO(name(way));
    Scene scene = empty_scene();
    scene.fracture = Fracture();
    scene.fracture->joints = {{{Selector::By::body, 0, 0, {}}, 0}};
    scene.balls = {ball(Vec3(0, 0.14, 1.5), Vec3(0, -3, 0), 0.1, 0.7)};
    // A spring that is bent a little, so that the joint breaks in the step in which the ball comes.
    make_tree::Wood soft;
    soft.youngs = soft.shear = 1e5;
    Tree tree = make_tree::chain(1, 2, 0.025, 0.025, 0, soft);
    tree.joint_rotation[0] = Quat::Identity();
    Pull pull;
    pull.on.body = 0;
    pull.time = {0, 1};
    pull.force = {Vec3(0.01, 0, 0), Vec3(0.01, 0, 0)};
    scene.pulls = {pull};
    FreeRun<> run(tree, scene, way);
    const double before = 0.7 * -3;
    run.steps(1);
    REQUIRE(run.world.free.size() == 2);
    REQUIRE(run.world.counts.hits == 1);
    CHECK(run.state.loads.empty());
    double after = 0;
    for (const FreeBody& free : run.world.free) after += free.mass * free.motion.v.y();
    CHECK(after == Approx(before).epsilon(1e-9));
    run.steps(3);
    CHECK(!first_non_finite(run.world));
}
