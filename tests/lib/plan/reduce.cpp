// Trees with rigid bodies: their reduced tree against sums over bodies, closed forms, and the same tree with very stiff joints.
#include "lib/plan/reduce.h"
#include "lib/laws/added_motion.h"
#include "lib/model/append.h"
#include "lib/model/drawn_pose.h"
#include "lib/model/split.h"
#include "lib/plan/expand.h"
#include "lib/study/solvers.h"
#include "tests/support/make_tree.h"
#include "tests/support/random_documents.h"
#include "tests/support/reduced.h"
#include "tests/support/simulate.h"
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace reduced;
using simulate::nothing;
using simulate::steady;

namespace {

Tree some_held(Tree tree, unsigned seed, double share) {
    make_tree::Dice dice{std::mt19937(seed)};
    tree.rigid.resize(tree.size_bodies());
    for (auto& rigid : tree.rigid) rigid = dice(0, 1) < share;
    return tree;
}

// A random tree whose joints each turn by a few degrees under the weight they carry.
Tree sturdy(int bodies, unsigned seed) {
    Tree tree = make_tree::random_tree(bodies, seed);
    const std::vector<double> reach = composite_reach(tree);
    std::vector<double> mass(tree.mass);
    for (std::size_t i = tree.size_bodies(); i-- > 0;) {
        tree.stiffness[i] = Vec3::Constant(30 * mass[i] * 9.81 * reach[i]);
        if (tree.parent[i] >= 0) mass[std::size_t(tree.parent[i])] += mass[i];
    }
    return tree;
}

// First moment and inertia about body j's joint of it and all it carries, drawn, world axes.
struct Moments {
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
};
Moments composite(const Tree& tree, std::size_t j) {
    const DrawnPose drawn = drawn_pose(tree);
    Moments sum;
    for (std::size_t i = j; i < tree.size_bodies(); ++i) {
        std::int64_t on = std::int64_t(i);
        while (on > std::int64_t(j)) on = tree.parent[std::size_t(on)];
        if (on != std::int64_t(j)) continue;
        const Vec3 c = drawn.x_w[i] + drawn.R_wb[i] * tree.com[i] - drawn.x_w[j];
        sum.first += tree.mass[i] * c;
        sum.second += drawn.R_wb[i] * tree.inertia[i] * drawn.R_wb[i].transpose() +
                      tree.mass[i] * (c.squaredNorm() * Mat3::Identity() - c * c.transpose());
    }
    return sum;
}

// Poses and velocities of all bodies, as a frame has them.
MotionFrame frame_of(const Plan<double>& plan, const State<double>& state) {
    MotionFrame frame;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        frame.position.push_back(state.x_w[i]);
        frame.rotation.push_back(Quat(state.R_wb[i]).normalized());
        frame.theta.push_back(state.theta[i]);
        if (!plan.velocity) continue;
        frame.velocity.push_back(state.v_w[i]);
        frame.angular_velocity.push_back(state.omega_w[i]);
    }
    return frame;
}

double apart(const Quat& a, const Quat& b) {
    return (a.toRotationMatrix() - b.toRotationMatrix()).norm();
}

} // namespace

TEST_CASE("each joint carries the first moment and inertia that it did") {
    for (const double share : {0.2, 0.6, 0.95}) {
        const Tree tree = some_held(make_tree::random_tree(120, 3), 5, share);
        const Reduced r = reduced_of(tree);
        REQUIRE(r.tree.size_bodies() == r.leader.size());
        REQUIRE(r.tree.size_bodies() + std::size_t(std::count(tree.rigid.begin(), tree.rigid.end(), 1)) ==
                tree.size_bodies());
        for (std::size_t g = 0; g < r.leader.size(); ++g) {
            const auto lead = std::size_t(r.leader[g]);
            const Moments is = composite(r.tree, g), was = composite(tree, lead);
            CHECK((is.first - was.first).norm() <= 1e-12 * was.first.norm());
            CHECK((is.second - was.second).norm() <= 1e-12 * was.second.norm());
            CHECK(r.tree.mass[g] > 0);
            CHECK(Eigen::SelfAdjointEigenSolver<Mat3>(r.tree.inertia[g]).eigenvalues()[0] >= 0);
            CHECK(r.tree.parent[g] < std::int32_t(g));
            CHECK(tree.rigid[lead] == 0);
            CHECK(r.tree.stiffness[g] == tree.stiffness[lead]);
        }
    }
}

TEST_CASE("without rigid bodies the reduced tree is the tree, bit by bit") {
    Tree tree = make_tree::random_tree(150, 8);
    tree.rigid.assign(tree.size_bodies(), 0);
    const Reduced r = reduced_of(tree);
    tree.rigid.clear();
    CHECK(bough::test::same(r.tree, tree));
    CHECK(r.tree.rigid.empty());
    // ... and so is each body that is alone in its group and bears no group of several.
    const Tree some = some_held(tree, 2, 0.3);
    const Reduced part = reduced_of(some);
    std::vector<int> members(part.leader.size(), 0);
    for (const std::int32_t g : part.body)
        if (g >= 0) ++members[std::size_t(g)];
    std::vector<bool> bears(members.size(), false);
    for (std::size_t g = 0; g < members.size(); ++g)
        if (members[g] > 1 && part.tree.parent[g] >= 0) bears[std::size_t(part.tree.parent[g])] = true;
    int alone = 0;
    for (std::size_t g = 0; g < members.size(); ++g) {
        if (members[g] > 1 || bears[g]) continue;
        ++alone;
        const auto i = std::size_t(part.leader[g]);
        CHECK((part.tree.mass[g] == tree.mass[i] && part.tree.com[g] == tree.com[i] &&
               part.tree.inertia[g] == tree.inertia[i] && part.tree.size[g] == tree.size[i]));
    }
    CHECK(alone > 10);
}

TEST_CASE("a rigid chain on one joint rings as a physical pendulum does") {
    // 12 pieces of a cylinder of 2 m, radius 2 cm; about its end I = m l^2 / 3 + m r^2 / 4.
    Tree tree = make_tree::chain(12, 2, 0.02, 0.02, 0, {800, 5e9, 5e8, 0});
    tree.rigid.assign(tree.size_bodies(), 1);
    tree.rigid[0] = 0;
    tree.stiffness[0] = Vec3(300, 300, 50);
    const Reduced r = reduced_of(tree);
    REQUIRE(r.tree.size_bodies() == 1);
    const double m = 800 * std::numbers::pi * 0.02 * 0.02 * 2, I = m * 4 / 3 + m * 0.02 * 0.02 / 4;
    const double dt = 1e-3, period = 2 * std::numbers::pi * std::sqrt(I / 300);
    const Plan<double> plan = plan_of(r.tree, r.ranges, nothing(), dt);
    State<double> state = make_state(plan);
    state.theta[0] = Vec3(1e-3, 0, 0);
    restart(plan, state);
    std::vector<double> crossings; // downward
    for (double before = 1e-3; crossings.size() < 4; before = state.theta[0].x()) {
        REQUIRE(double(state.step) * dt < 10 * period);
        advance(plan, state);
        const double now = state.theta[0].x();
        if (before > 0 && now <= 0) crossings.push_back((double(state.step) - now / (now - before)) * dt);
    }
    CHECK((crossings[3] - crossings[0]) / 3 == Approx(period).epsilon(2e-5));
    CHECK(crossings[0] == Approx(period / 4).epsilon(1e-3));
}

TEST_CASE("rigid runs as a billion times stiffer does, all bodies and velocities") {
    const Tree drawn = make_tree::branched();
    Tree stiff = drawn, held = drawn;
    held.rigid = {0, 1, 0, 1, 0, 1, 1, 0, 1, 0, 1, 0, 1, 0};
    held.rigid.resize(drawn.size_bodies(), 1);
    for (std::size_t i = 0; i < stiff.size_bodies(); ++i)
        if (held.rigid[i]) stiff.stiffness[i] *= 1e9;
    Scene scene;
    Pull pull;
    pull.on.by = Selector::By::level;
    pull.on.level = 1;
    pull.time = {0, 0.3, 0.31};
    pull.force = {Vec3::Zero(), Vec3(10, -5, 20), Vec3::Zero()};
    scene.pulls.push_back(pull);
    const Reduced r = reduced_of(held, scene);
    const double dt = 1.0 / 240;
    const Plan<double> whole_plan = plan_of(stiff, all_of(stiff), scene, dt);
    const Plan<double> plan = plan_of(r.tree, r.ranges, scene_on(r, held, scene), dt);
    State<double> whole = make_state(whole_plan), state = make_state(plan);
    double worst = 0, moved = 0, worst_speed = 0, speed = 0;
    for (int k = 0; k < 240; ++k) {
        advance(whole_plan, whole);
        advance(plan, state);
        MotionFrame frame = frame_of(plan, state);
        expand_frame(r, held, plan, state, frame);
        REQUIRE(frame.position.size() == stiff.size_bodies());
        for (std::size_t i = 0; i < stiff.size_bodies(); ++i) {
            worst = std::max(worst, (frame.position[i] - whole.x_w[i]).norm());
            moved = std::max(moved, (whole.x_w[i] - drawn_pose(drawn).x_w[i]).norm());
            worst_speed = std::max(worst_speed, (frame.velocity[i] - whole.v_w[i]).norm());
            speed = std::max(speed, whole.v_w[i].norm());
        }
    }
    INFO("moved " << moved << ", off by " << worst << "; speed " << speed << ", off by " << worst_speed);
    CHECK(moved > 1e-3);
    CHECK(worst < 1e-5 * moved);
    CHECK(worst_speed < 1e-4 * speed);
}

TEST_CASE("bodies of a group keep their places to each other, and their joints have not turned") {
    const Tree tree = some_held(sturdy(120, 6), 9, 0.7);
    Scene scene;
    scene.wind = wind_preset("storm");
    const Reduced r = reduced_of(tree, scene);
    const Plan<double> plan = plan_of(r.tree, r.ranges, scene);
    State<double> state = make_state(plan);
    const DrawnPose drawn = drawn_pose(tree);
    double moved = 0;
    for (int k = 0; k < 60; ++k) advance(plan, state);
    MotionFrame frame = frame_of(plan, state);
    expand_frame(r, tree, plan, state, frame);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        moved = std::max(moved, (frame.position[i] - drawn.x_w[i]).norm());
        if (!tree.rigid[i]) continue;
        CHECK(frame.theta[i].isZero(0));
        const std::int32_t p = tree.parent[i];
        if (p < 0) {
            CHECK((frame.position[i] - drawn.x_w[i]).norm() == 0);
            continue;
        }
        const auto q = std::size_t(p);
        const Vec3 place = frame.position[q] + frame.rotation[q] * tree.joint_position[i];
        CHECK((frame.position[i] - place).norm() < 1e-13);
        CHECK(apart(frame.rotation[i], frame.rotation[q] * tree.joint_rotation[i]) < 1e-13);
        // A rigid body's velocities: v of one point and omega give those of all.
        const Vec3 arm =
            frame.position[i] + frame.rotation[i] * tree.com[i] - frame.position[q] - frame.rotation[q] * tree.com[q];
        CHECK((frame.velocity[i] - frame.velocity[q] - frame.angular_velocity[q].cross(arm)).norm() < 1e-12);
        CHECK(frame.angular_velocity[i] == frame.angular_velocity[q]);
    }
    CHECK(moved > 1e-3);
}

TEST_CASE("the drawn tree is in equilibrium under gravity with parts of it rigid") {
    const Tree tree = some_held(sturdy(150, 11), 1, 0.5);
    const Reduced r = reduced_of(tree);
    const Plan<double> plan = plan_of(r.tree, r.ranges, Scene());
    State<double> state = make_state(plan);
    const DrawnPose drawn = drawn_pose(tree);
    for (int k = 0; k < 120; ++k) advance(plan, state);
    double moved = 0, torque = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        moved = std::max(moved, (whole_pose(r, plan, state, i).x - drawn.x_w[i]).norm());
        if (r.body[i] >= 0) torque = std::max(torque, state.theta[std::size_t(r.body[i])].norm());
    }
    CHECK(moved < 1e-10);
    CHECK(torque > 1e-6); // it hangs on its springs
}

TEST_CASE("what hangs on a part that stands still is a root at its place, and moves with the ground") {
    Tree tree = make_tree::branched();
    tree.rigid.assign(tree.size_bodies(), 0);
    for (std::size_t i = 0; i < 4; ++i) tree.rigid[i] = 1; // the trunk
    Scene scene;
    RootMotion motion;
    motion.time = {0, 1};
    motion.position = {Vec3::Zero(), Vec3(0.4, 0.1, -0.2)};
    motion.rotation = {Quat::Identity(), make_tree::turn(0.5, Vec3(0.1, 1, 0.3))};
    scene.root_motion.push_back(motion);
    const Reduced r = reduced_of(tree, scene);
    CHECK(std::count(r.tree.parent.begin(), r.tree.parent.end(), -1) == 4); // branches 1 to 3 and what the trunk bears
    const Plan<double> plan = plan_of(r.tree, r.ranges, scene);
    State<double> state = make_state(plan);
    const DrawnPose drawn = drawn_pose(tree);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK((whole_pose(r, plan, state, i).x - drawn.x_w[i]).norm() < 1e-13);
        CHECK((whole_pose(r, plan, state, i).R - drawn.R_wb[i]).norm() < 1e-13);
    }
    for (int k = 0; k < 90; ++k) advance(plan, state); // to rest in the last key's place
    const Mat3 R = motion.rotation[1].toRotationMatrix();
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK((whole_pose(r, plan, state, i).x - R * drawn.x_w[i] - motion.position[1]).norm() < 1e-12);
        CHECK((whole_pose(r, plan, state, i).R - R * drawn.R_wb[i]).norm() < 1e-12);
    }
    // Joints on the trunk are where the trunk has them.
    MotionFrame frame = frame_of(plan, state);
    expand_frame(r, tree, plan, state, frame);
    for (std::size_t i = 4; i < tree.size_bodies(); ++i) {
        if (tree.parent[i] > 3) continue;
        const auto p = std::size_t(tree.parent[i]);
        CHECK((frame.position[i] - frame.position[p] - frame.rotation[p] * tree.joint_position[i]).norm() < 1e-12);
    }
    CHECK(frame.velocity[2].norm() == 0);
}

TEST_CASE("a tree that stands still beside one that moves") {
    Tree joined = make_tree::branched();
    const std::size_t first = append(joined, make_tree::chain(4, 2, 0.03, 0.01), Vec3(5, 0, 0), 0.3);
    joined.rigid.assign(joined.size_bodies(), 0);
    for (std::size_t i = 0; i < first; ++i) joined.rigid[i] = 1;
    const std::vector<TreeRange> ranges{{0, first, 0}, {first, joined.size_bodies() - first, 5}};
    Scene scene;
    scene.trees.resize(2);
    for (int k = 0; k < 2; ++k) {
        RootMotion motion;
        motion.tree = k;
        motion.time = {0, 1};
        motion.position = {Vec3::Zero(), Vec3(k + 1, 0, 0)};
        scene.root_motion.push_back(motion);
    }
    const Reduced r = reduce(joined, ranges, scene);
    REQUIRE(r.tree.size_bodies() == 4);
    CHECK((r.ranges[0].bodies == 0 && r.ranges[1].first_body == 0 && r.ranges[1].bodies == 4));
    const Plan<double> plan = plan_of(r.tree, r.ranges, scene);
    State<double> state = make_state(plan);
    for (int k = 0; k < 120; ++k) advance(plan, state);
    const DrawnPose drawn = drawn_pose(joined);
    CHECK((whole_pose(r, plan, state, 0).x - drawn.x_w[0] - Vec3(1, 0, 0)).norm() < 1e-12);
    CHECK((whole_pose(r, plan, state, first).x - drawn.x_w[first] - Vec3(2, 0, 0)).norm() < 1e-12);
}

TEST_CASE("what a scene selects stays where it was") {
    Tree joined = make_tree::branched();
    const std::size_t first = append(joined, make_tree::branched(), Vec3(3, 0, 1), 0.7);
    joined = some_held(joined, 3, 0.6);
    joined.rigid[0] = 1;
    const std::vector<TreeRange> ranges{{0, first, 0}, {first, joined.size_bodies() - first, 5}};
    const Reduced r = reduce(joined, ranges, Scene());
    const DrawnPose whole = drawn_pose(joined), part = drawn_pose(r.tree);
    int still = 0;
    for (std::size_t i = 0; i < joined.size_bodies(); ++i) {
        const Vec3 point(0.01, 0.02, 0.03 * double(i));
        const std::optional<Selector> on = selector_on(r, {i, point});
        if (!on) {
            ++still;
            continue;
        }
        const std::vector<Selected> found = select(r.tree, r.ranges, *on);
        REQUIRE(found.size() == 1);
        const Vec3 there = part.x_w[found[0].body] + part.R_wb[found[0].body] * found[0].point_b;
        CHECK((there - whole.x_w[i] - whole.R_wb[i] * point).norm() < 1e-13);
        CHECK(on->tree == (i < first ? 0 : 1));
    }
    CHECK(still > 0);
    Scene scene;
    Pull pull;
    pull.on.by = Selector::By::level;
    pull.on.level = 0;
    pull.time = {0};
    pull.force = {Vec3(1, 0, 0)};
    scene.pulls.push_back(pull);
    std::size_t moving = 0;
    for (const Selected& on : select(joined, ranges, pull.on)) moving += r.body[on.body] >= 0;
    CHECK(scene_on(r, joined, scene).pulls.size() == moving);
    CHECK(moving < select(joined, ranges, pull.on).size());
    pull.on.level = 7;
    scene.pulls = {pull};
    CHECK_THROWS_AS(scene_on(r, joined, scene), std::out_of_range);
}

TEST_CASE("rigid bodies that nobody joined are not run") {
    Tree tree = make_tree::chain(3, 1, 0.02, 0.01);
    tree.rigid = {0, 1, 0};
    CHECK_THROWS_AS(plan_of(tree, all_of(tree), Scene()), std::domain_error);
    tree.rigid.clear();
    Scene scene;
    scene.simulate.emplace();
    CHECK_THROWS_AS(plan_of(tree, all_of(tree), scene), std::domain_error);
    CHECK_NOTHROW(plan_of(tree, all_of(tree), Scene()));
}

TEST_CASE("rigid bodies keep through joining and splitting of trees") {
    Tree a = make_tree::chain(3, 1, 0.02, 0.01), b = make_tree::branched(), joined;
    b.rigid.assign(b.size_bodies(), 0);
    b.rigid[5] = 1;
    a.load = {0.5, 0, 1};
    append(joined, a, Vec3::Zero(), 0);
    CHECK(joined.rigid.empty());
    append(joined, b, Vec3(1, 0, 0), 0);
    append(joined, a, Vec3(2, 0, 0), 0);
    REQUIRE(joined.rigid.size() == joined.size_bodies());
    CHECK(std::count(joined.rigid.begin(), joined.rigid.end(), 1) == 1);
    CHECK(joined.rigid[8] == 1);
    REQUIRE(joined.load.size() == joined.size_bodies());
    CHECK((joined.load[0] == 0.5 && joined.load[2] == 1 && joined.load[5] == 0 && joined.load.back() == 1));
    CHECK_FALSE(check(joined));
    const std::vector<Tree> parts = split_roots(joined);
    REQUIRE(parts.size() == 3);
    CHECK(parts[1].rigid == b.rigid);
    CHECK(parts[2].load == a.load);
    joined.rigid[3] = 2;
    REQUIRE(check(joined));
    CHECK(check(joined)->field == "rigid");
    joined.rigid.pop_back();
    CHECK(check(joined)->field == "rigid");
}
