// Forces of wind and pulls against values worked out by hand for a cylinder, a sphere and a plate.
#include "lib/analytic/external_forces.h"
#include "lib/plan/pushes.h"
#include "lib/plan/reduced.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace solver;

namespace {

using std::numbers::pi;

// One body of the kind, upright at the origin: body z is world y, body y is world -z, body x is world x.
Tree one_body(Kind kind) {
    Tree tree;
    if (kind == Kind::branch)
        make_tree::add_piece(tree, -1, Vec3::Zero(), make_tree::upright(), 2, 0.05, 0.03, 0, 0, 0);
    if (kind == Kind::leaf) make_tree::add_leaf(tree, -1, Vec3::Zero(), make_tree::upright(), 0.1, 0.06, 3e-4, 0, 0, 0);
    // Fourteen leaves of 9 cm, most of which face up; those of a tuft are narrow.
    if (kind == Kind::clump || kind == Kind::tuft) {
        make_tree::add_leaf(tree, -1, Vec3::Zero(), make_tree::upright(), 0.3, kind == Kind::tuft ? 0.03 : 0.2, 3e-3, 0,
                            0, 0);
        tree.leaf_count = {14};
        tree.leaf_facing = {0.7};
    }
    if (kind == Kind::fruit) make_tree::add_fruit(tree, -1, Vec3::Zero(), make_tree::upright(), 0.05, 0.03, 0, 0, 0);
    return tree;
}

struct Blown {
    Plan<double> plan;
    State<double> state;
};

// The body in a uniform wind, its centre of mass at a given velocity.
Blown blow(const Tree& tree, const Vec3& wind, const Vec3& velocity = Vec3::Zero(), double profile = 0) {
    Scene scene = empty_scene();
    scene.wind = Wind{};
    scene.wind->velocity = wind;
    scene.wind->profile = profile;
    Blown b{plan_of(tree, scene), {}};
    b.state = make_state(b.plan);
    b.state.v_w[0] = velocity;
    evaluate_wind(*scene.wind, 0, b.state.wind);
    parts::external_forces(b.plan, b.state, 0);
    return b;
}

bool close(const Vec3& a, const Vec3& b) {
    return (a - b).norm() <= 1e-12 * (a.norm() + b.norm());
}

} // namespace

TEST_CASE("(21): a branch takes the wind across it, on the section of its axis") {
    const double area = 2 * 2 * 0.04; // length times mean diameter
    const Blown b = blow(one_body(Kind::branch), {3, 10, 4});
    // Across the upright axis: (3, 0, 4) of speed 5. kappa rho A = 0.6 1.2 0.16.
    const Vec3 expected = 0.6 * 1.2 * area * 5 * Vec3(3, 0, 4);
    CHECK(close(parts::joints(b.state).f_w[0], expected));
    const double arm = b.plan.com[0].z();
    CHECK(close(parts::joints(b.state).tau_w[0], Vec3(0, arm, 0).cross(expected)));
    CHECK(parts::joints(b.state).drag_f_w[0].norm() < 1e-15);
    CHECK(parts::joints(b.state).drag_bound[0] == Approx(0.6 * 1.2 * area * 10).epsilon(1e-12));
    CHECK(parts::joints(blow(one_body(Kind::branch), {0, 10, 0}).state).f_w[0].norm() < 1e-12);
}

TEST_CASE("(22): a fruit takes the wind on its disc, from any side") {
    const double scale = 0.235 * 1.2 * pi * 0.03 * 0.03;
    for (const Vec3& u : {Vec3(3, 0, 4), Vec3(0, 5, 0), Vec3(-1, -2, 2)})
        CHECK(close(parts::joints(blow(one_body(Kind::fruit), u).state).f_w[0], scale * u.norm() * u));
}

TEST_CASE("(23): a leaf takes the wind's part along its normal, a quarter of it from all sides, folded by the wind") {
    const double scale = 0.6 * 1.2 * 0.1 * 0.06 / 2;
    const Blown b = blow(one_body(Kind::leaf), {3, 0, 4});
    const auto folded = [](double speed) { return speed / (1 + speed / 7.5); };
    CHECK(close(parts::joints(b.state).f_w[0],
                scale * folded(5) * (0.75 * Vec3(0, 0, 4) + 0.25 * Vec3(3, 0, 4)))); // n along z
    const Vec3 along(5, 2, 0);
    CHECK(close(parts::joints(blow(one_body(Kind::leaf), along).state).f_w[0],
                scale * folded(along.norm()) * 0.25 * along));
}

TEST_CASE("force at rest and drag together are the force of the relative wind, the drag within its bound") {
    make_tree::Dice dice{std::mt19937(1)};
    for (Kind kind : {Kind::branch, Kind::leaf, Kind::fruit, Kind::clump, Kind::tuft})
        for (int k = 0; k < 200; ++k) {
            const Vec3 wind = random_vector(dice, 10), v = random_vector(dice, k % 2 ? 10 : 0.1);
            const Tree tree = one_body(kind);
            CHECK(kind_in_air(tree, 0) == kind);
            const Blown b = blow(tree, wind, v);
            const Vec3 relative = parts::joints(blow(tree, wind - v).state).f_w[0];
            CHECK((parts::joints(b.state).f_w[0] + parts::joints(b.state).drag_f_w[0] - relative).norm() <
                  1e-13 * (1 + parts::joints(b.state).f_w[0].norm()));
            CHECK(parts::joints(b.state).drag_f_w[0].norm() <=
                  parts::joints(b.state).drag_bound[0] * v.norm() * (1 + 1e-12));
            // It brakes; a leaf's, clump's and tuft's, in a wind, need not: moving in the leaf's plane changes |u| and with it the force along n.
            if (kind == Kind::branch || kind == Kind::fruit) CHECK(parts::joints(b.state).drag_f_w[0].dot(v) <= 1e-15);
            const Vec3 arm = b.state.R_wb[0] * b.plan.com[0];
            CHECK((parts::joints(b.state).drag_tau_w[0] - arm.cross(parts::joints(b.state).drag_f_w[0])).norm() <
                  1e-13);
        }
}

TEST_CASE("a body feels the wind of its centre of mass' height, from the table") {
    Tree tree = one_body(Kind::fruit);
    const auto speed = [&](double y) {
        tree.joint_position[0] = Vec3(0, y - 0.05, 0); // the fruit's centre is 0.05 m above its joint
        const Vec3 f = parts::joints(blow(tree, {8, 0, 0}, Vec3::Zero(), 1).state).f_w[0];
        return std::sqrt(f.x() / (0.235 * 1.2 * pi * 0.03 * 0.03));
    };
    // With exponent 1 the profile is linear, so the table is exact: 8 m/s at 10 m.
    for (double y : {0.5, 2.0, 5.0, 9.3}) CHECK(speed(y) == Approx(0.8 * y).epsilon(1e-9));
    CHECK(speed(-1) == 0);
}

TEST_CASE("a pull is linear between its keys and absent outside them") {
    Pull pull;
    pull.time = {1, 2, 4};
    pull.force = {Vec3(2, 0, 0), Vec3(4, 6, 0), Vec3(0, 0, 8)};
    CHECK(pull_force(pull, 0.999) == Vec3::Zero());
    CHECK(pull_force(pull, 1) == Vec3(2, 0, 0));
    CHECK(close(pull_force(pull, 1.25), Vec3(2.5, 1.5, 0)));
    CHECK(pull_force(pull, 2) == Vec3(4, 6, 0));
    CHECK(close(pull_force(pull, 3.5), Vec3(1, 1.5, 6)));
    CHECK(pull_force(pull, 4) == Vec3(0, 0, 8));
    CHECK(pull_force(pull, 4.001) == Vec3::Zero());
    CHECK(pull_force(Pull{}, 0) == Vec3::Zero());
}

TEST_CASE("a pull on a point turns about the body's own joint, and pulls add up") {
    const Tree tree = make_tree::chain(3, 3, 0.05, 0.02);
    Scene scene = empty_scene();
    Pull pull;
    pull.time = {0, 2};
    pull.force = {Vec3(1, 0, 0), Vec3(3, 0, 0)};
    pull.on.by = Selector::By::branch;
    pull.on.branch = 0;
    pull.on.at = 0.5; // of three pieces: the middle of the second
    scene.pulls.push_back(pull);
    pull.on = Selector{};
    pull.on.body = 1;
    scene.pulls.push_back(pull);
    const auto plan = plan_of(tree, scene);
    State<double> state = make_state(plan);
    for (double t : {1.0, 1.5, 5.0}) { // forces of the step before leave nothing behind
        parts::external_forces(plan, state, t);
        const Vec3 f(t > 2 ? 0 : 1 + t, 0, 0);
        CHECK(close(parts::joints(state).f_w[1], 2 * f));
        CHECK(close(parts::joints(state).tau_w[1], Vec3(0, 0.5 + tree.com[1].z(), 0).cross(f)));
        CHECK(parts::joints(state).f_w[0].norm() + parts::joints(state).tau_w[0].norm() +
                  parts::joints(state).f_w[2].norm() + parts::joints(state).tau_w[2].norm() ==
              0);
    }
}

TEST_CASE("a pull on a level is on each of its branch bodies, at the centre of mass") {
    const Tree tree = make_tree::branched();
    Scene scene = empty_scene();
    Pull pull;
    pull.time = {0, 1};
    pull.force = {Vec3(0, 0, 5), Vec3(0, 0, 5)};
    pull.on.by = Selector::By::level;
    pull.on.level = 1;
    scene.pulls.push_back(pull);
    const auto plan = plan_of(tree, scene);
    State<double> state = make_state(plan);
    parts::external_forces(plan, state, 0.5);
    int pulled = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const bool meant = tree.kind[i] == Kind::branch && tree.level[i] == 1;
        pulled += meant;
        const Vec3 f = meant ? Vec3(0, 0, 5) : Vec3(Vec3::Zero()), arm = state.R_wb[i] * tree.com[i];
        CHECK(close(parts::joints(state).f_w[i], f));
        CHECK((parts::joints(state).tau_w[i] - arm.cross(f)).norm() < 1e-13);
    }
    CHECK(pulled == 5);
    scene.pulls[0].on.level = 3;
    CHECK_THROWS_AS(plan_of(tree, scene), std::out_of_range);
}
