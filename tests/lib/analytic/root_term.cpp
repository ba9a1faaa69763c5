// What a moving ground does to a tree, against closed forms, tilted gravity, and an integration of one rod's equation.
#include "lib/analytic/root_term.h"
#include "lib/plan/ground.h"
#include "lib/plan/pose.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace simulate;

namespace {

RootMotion root_keys() {
    RootMotion m;
    m.time = {0, 1};
    m.position.assign(2, Vec3::Zero());
    m.rotation.assign(2, Quat::Identity());
    return m;
}

// A run whose one spline is replaced by a hand-built one, which keys with their rest at both ends could not give.
template <class T = double>
PlainRun<T> run_on(const Tree& tree, Scene scene, const RootSpline& spline, double dt = 1.0 / 30,
                   const Wishes& w = {}) {
    scene.root_motion = {root_keys()};
    PlainRun<T> run(tree, scene, dt, w);
    run.plan.splines = {spline};
    run.state = make_state(run.plan);
    return run;
}

// Steady acceleration, or steady speed, from t = 0 for a thousand seconds.
RootSpline driven(const Vec3& v, const Vec3& a) {
    const double T = 1000;
    RootSpline s;
    s.position = QuinticSpline{{0, T}, {Vec3::Zero(), v * T + a * (T * T / 2)}, {v, v + a * T}, {a, a}};
    return s;
}

RootSpline spun(const Vec3& omega, const Vec3& pivot) {
    const double T = 1000;
    RootSpline s;
    s.rotation = QuinticSpline{{0, T}, {Vec3::Zero(), omega * T}, {omega, omega}, {Vec3::Zero(), Vec3::Zero()}};
    s.pivot = pivot;
    return s;
}

Scene at_rest(const Vec3& gravity) {
    Scene scene;
    scene.gravity = gravity;
    scene.pose = Pose::rest;
    return scene;
}

// One upright rod; bends about its x and y.
Tree rod(double youngs, double damping) {
    make_tree::Wood wood;
    wood.youngs = youngs;
    wood.damping = damping;
    return make_tree::chain(1, 1, 0.02, 0.015, 0, wood);
}

double difference(const State<double>& a, const State<double>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.theta.size(); ++i) most = std::max(most, (a.theta[i] - b.theta[i]).norm());
    return most;
}

template <class F> double root_of(F f, double low, double high) {
    for (int k = 0; k < 200; ++k) {
        const double middle = (low + high) / 2;
        ((f(middle) > 0) == (f(low) > 0) ? low : high) = middle;
    }
    return low;
}

} // namespace

TEST_CASE("A root that accelerates steadily is gravity tilted the other way, in statics exactly") {
    const Vec3 a(3, 1, -2), g = GENERATE(Vec3(0, -9.81, 0), Vec3(0, 0, 0));
    make_tree::Wood wood;
    wood.youngs = 5e8;
    wood.damping = 0.1;
    for (const Tree& tree : {make_tree::chain(6, 2, 0.03, 0.015, 0.1, wood), make_tree::branched()}) {
        Scene scene = at_rest(g);
        scene.damping_scale = tree.size_bodies() > 6 ? 10 : 1;
        PlainRun<double> moved = run_on(tree, scene, driven(Vec3::Zero(), a));
        scene.gravity = g - a;
        PlainRun<double> still(tree, scene);
        moved.steps(15000);
        still.steps(15000);
        REQUIRE(still.largest_angle() > 0.01);
        CHECK(difference(moved.state, still.state) < 1e-9);
        // And that rest is the settled pose in the tilted gravity, which no step has found.
        const StartPose settled = start_pose(tree, g - a, Pose::settled);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            CHECK((moved.state.theta[i] - settled.theta[i]).norm() < 1e-9);
        CHECK((moved.state.x_w[0] - still.state.x_w[0] - a * (0.5 * 500 * 500)).norm() < 1e-6);
    }
}

TEST_CASE("A rod on a turning table leans to the balance of spring, gravity and the centrifugal moment") {
    const double r = 0.7, gravity = GENERATE(0.0, 9.81), omega = GENERATE(2.0, -6.0);
    Tree tree = rod(2e8, 0.03);
    tree.joint_position[0] = Vec3(r, 0, 0);
    const Vec3 pivot(0, 0, 0);
    PlainRun<double> run = run_on(tree, at_rest(Vec3(0, -gravity, 0)), spun(Vec3(0, omega, 0), pivot));
    run.steps(9000);
    const double m = tree.mass[0], c = tree.com[0].z(), K = tree.stiffness[0].x();
    const double along = tree.inertia[0](2, 2), across = tree.inertia[0](0, 0) + m * c * c;
    const double lean = root_of(
        [&](double t) {
            const double swing = omega * omega * std::cos(t) * (m * c * r + (across - along) * std::sin(t));
            return swing + m * gravity * c * std::sin(t) - K * t;
        },
        0, 1.5);
    REQUIRE(lean > 0.01);
    CHECK(run.largest_angle() == Approx(lean).epsilon(1e-9));
    // Outwards, wherever the table has turned to.
    const Vec3 tip = run.state.R_wb[0].col(2), out = run.state.x_w[0] / r;
    CHECK(std::asin(tip.dot(out)) == Approx(lean).epsilon(1e-9));
}

TEST_CASE("The term is the moment that carrying every body with the ground takes, summed body by body") {
    // A ground in general motion, the tree in a general pose: sum of r x m a + I alpha + omega x I omega over the bodies.
    const Tree tree = make_tree::branched();
    RootMotion m = root_keys();
    m.position = {{0, 0, 0}, {1, -0.5, 2}};
    m.rotation = {make_tree::turn(0.3, Vec3(1, 0, 1)), make_tree::turn(1.9, Vec3(0, 1, 0.4))};
    PlainRun<double> run = run_on(tree, at_rest(Vec3(0.3, -9.81, 0)), make_root_spline(m, Vec3(0.4, 0, -0.7)), 1e-7);
    make_tree::Dice dice{std::mt19937(3)};
    for (Vec3& theta : run.state.theta) theta = Vec3(dice(-0.5, 0.5), dice(-0.5, 0.5), dice(-0.5, 0.5));
    run.state.step = 3500000; // t = 0.35 s
    move_ground(run.plan, run.state, 0.35);
    state_update(run.plan, run.state);
    advance(run.plan, run.state); // fills composites of the pose before, to rounding the present one
    const Ground g = ground_at(run.plan.splines[0], 0.35);
    const auto field = [&](const Vec3& x) {
        return Vec3(g.a + g.alpha.cross(x - g.x) + g.omega.cross(g.omega.cross(x - g.x)));
    };
    const RootLoad<double>& load = parts::joints(run.state).root_load[0];
    const std::size_t n = tree.size_bodies();
    for (std::size_t j = 0; j < n; ++j) {
        Vec3 truth = Vec3::Zero();
        for (std::size_t b = j; b < n; ++b) {
            std::int64_t up = std::int64_t(b);
            while (up > std::int64_t(j)) up = tree.parent[std::size_t(up)];
            if (up != std::int64_t(j)) continue;
            const Mat3& R = run.state.R_wb[b];
            const Vec3 x = run.state.x_w[b] + R * tree.com[b];
            const Mat3 I = R * tree.inertia[b] * R.transpose();
            truth += (x - run.state.x_w[j]).cross(tree.mass[b] * (run.plan.scene.gravity - field(x)));
            truth -= I * g.alpha + g.omega.cross(I * g.omega);
        }
        const Vec3 tau = parts::joints(run.state).c_h_w[j].cross(apparent_gravity(load, run.state.x_w[j])) -
                         turning_moment(load, parts::joints(run.state).c_J_w[j]);
        CAPTURE(j);
        CHECK((tau - truth).norm() < 1e-4 * truth.norm());
    }
}

TEST_CASE("The gradient is the derivative of the turning moment") {
    make_tree::Dice dice{std::mt19937(8)};
    const auto vector = [&] {
        const double a = dice(-2, 2), b = dice(-2, 2), c = dice(-2, 2);
        return Vec3(a, b, c);
    };
    Mat3 J = vector() * vector().transpose();
    J = (J * J.transpose() + Mat3::Identity()).eval();
    RootLoad<double> load{Vec3::Zero(), Vec3::Zero(), vector(), vector()};
    Mat3 slope;
    for (int k = 0; k < 3; ++k) {
        const auto at = [&](double h) {
            const Mat3 R = rotation_from_vector<double>(h * Vec3::Unit(k));
            return turning_moment<double>(load, R * J * R.transpose());
        };
        slope.col(k) = (at(1e-5) - at(-1e-5)) / 2e-5;
    }
    const Mat3 G = turning_gradient<double>(J, load.omega, load.alpha);
    CHECK((G - 0.5 * (slope + slope.transpose())).norm() < 1e-8 * G.norm());
}

TEST_CASE("A rod whose root is moved sideways answers as its equation says, to second order in the step") {
    const Tree tree = rod(2e8, 0.01);
    RootMotion m;
    m.time = {0, 0.4, 0.72, 1.6}; // at steps, so that the jumps of the third derivative are too
    m.position = {{0, 0, 0}, {0.02, 0, 0}, {-0.01, 0, 0}, {0.03, 0, 0}};
    Scene scene;
    scene.joint_inertia = JointInertia::paper;
    scene.root_motion = {m};
    const RootSpline spline = make_root_spline(m, Vec3::Zero());
    // I th'' + beta K th' + K th = m c (g sin th - a cos th), th leaning to +x.
    const double mass = tree.mass[0], c = tree.com[0].z(), K = tree.stiffness[0].x(), beta = tree.damping[0];
    const double I = tree.inertia[0](0, 0) + mass * c * c;
    const int fine = 20000;
    const double h = 2.0 / fine;
    double th = 0, rate = 0;
    const auto slope = [&](double t, double x, double v) {
        const double a = ground_at(spline, t).a.x();
        return (mass * c * (9.81 * std::sin(x) - a * std::cos(x)) - K * x - beta * K * v) / I;
    };
    std::vector<double> truth{0};
    for (int k = 0; k < fine; ++k) { // Runge-Kutta, fourth order
        const double t = k * h, a1 = slope(t, th, rate);
        const double v2 = rate + h / 2 * a1, a2 = slope(t + h / 2, th + h / 2 * rate, v2);
        const double v3 = rate + h / 2 * a2, a3 = slope(t + h / 2, th + h / 2 * v2, v3);
        const double v4 = rate + h * a3, a4 = slope(t + h, th + h * v3, v4);
        th += h / 6 * (rate + 2 * v2 + 2 * v3 + v4);
        rate += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        truth.push_back(th);
    }
    double largest = 0;
    for (const double x : truth) largest = std::max(largest, std::abs(x));
    REQUIRE(largest > 0.005);
    REQUIRE(largest < 0.3);
    std::vector<double> errors;
    for (const int steps : {125, 250, 500, 1000}) {
        PlainRun<double> run(tree, scene, 2.0 / steps);
        double worst = 0;
        for (int k = 1; k <= steps; ++k) {
            advance(run.plan, run.state);
            const double lean = std::asin(run.state.R_wb[0](0, 2));
            worst = std::max(worst, std::abs(lean - truth[std::size_t(k * (fine / steps))]));
        }
        errors.push_back(worst / largest);
    }
    CAPTURE(errors);
    CHECK(errors[3] < 1e-3);
    for (std::size_t k = 1; k < errors.size(); ++k) CHECK(errors[k - 1] / errors[k] == Approx(4).epsilon(0.15));
}

TEMPLATE_TEST_CASE("Equal keys change nothing, to the bit", "", float, double) {
    const Tree tree = make_tree::random_tree(300, 4);
    Scene scene;
    scene.gravity = GENERATE(Vec3(0, -9.81, 0), Vec3(0, 0, 0));
    scene.pose = Pose::rest;
    if (GENERATE(false, true)) scene.wind = wind_preset("gusty");
    PlainRun<TestType> still(tree, scene);
    RootMotion m = root_keys();
    if (GENERATE(false, true)) m.position.assign(2, Vec3(0, 0, 0.25)), m.rotation.clear();
    scene.root_motion = {m};
    PlainRun<TestType> moved(tree, scene);
    still.steps(60);
    moved.steps(60);
    CHECK(state_hash(moved.state) == state_hash(still.state));
    CHECK(moved.state.flags.buckling == still.state.flags.buckling);
    CHECK((moved.state.x_w[0] - still.state.x_w[0]).norm() == Approx(m.rotation.empty() ? 0.25 : 0).margin(1e-6));
}

TEST_CASE("A tree driven through still air is a tree that stands in the wind") {
    const Tree tree = make_tree::branched();
    Scene scene = at_rest(Vec3(0, -9.81, 0));
    scene.wind = still_air();
    PlainRun<double> moved = run_on(tree, scene, driven(Vec3(-9, 0, 2), Vec3::Zero()));
    scene.wind = steady(9);
    scene.wind->velocity = Vec3(9, 0, -2);
    PlainRun<double> blown(tree, scene);
    moved.steps(200);
    blown.steps(200);
    REQUIRE(blown.largest_angle() > 1e-3);
    CHECK(difference(moved.state, blown.state) < 1e-9);
}

TEST_CASE("Velocities on a moving ground are the derivatives of the places") {
    const Tree tree = make_tree::branched();
    RootMotion m = root_keys();
    m.position = {{0, 0, 0}, {0.5, 0.2, -0.3}};
    m.rotation = {Quat::Identity(), make_tree::turn(1.5, Vec3(0.3, 1, 0))};
    Scene scene;
    scene.root_motion = {m};
    const double dt = 1e-5;
    PlainRun<double> run(tree, scene, dt, {true, false});
    run.state.step = 45000;
    move_ground(run.plan, run.state, 0.45);
    state_update(run.plan, run.state);
    const auto places = [&] {
        std::vector<Vec3> x;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            x.push_back(run.state.x_w[i] + run.state.R_wb[i] * tree.com[i]);
        return x;
    };
    const std::vector<Vec3> before = places();
    advance(run.plan, run.state);
    const std::vector<Vec3> v = run.state.v_w;
    advance(run.plan, run.state);
    const std::vector<Vec3> after = places();
    for (std::size_t i = 0; i < v.size(); ++i) CHECK(((after[i] - before[i]) / (2 * dt) - v[i]).norm() < 1e-3);
}

TEST_CASE("Of two trees the one that is named moves, and the wind's table covers it") {
    const Tree tree = make_tree::branched();
    Tree both = make_tree::forest({tree, tree});
    const std::size_t n = tree.size_bodies();
    Scene scene;
    scene.trees = {{"a", Vec3::Zero(), 0}, {"b", Vec3::Zero(), 0}};
    scene.wind = wind_preset("breeze");
    RootMotion m = root_keys();
    m.tree = 1;
    m.position[1] = Vec3(1, 7, 0);
    scene.root_motion = {m};
    const std::vector<TreeRange> ranges{{0, n, 0}, {n, n, 5}};
    const Plan<double> plan = make_plan<double>(both, ranges, scene, {}, 0.01, Solver::analytic);
    Scene plain = scene;
    plain.root_motion.clear();
    const Plan<double> resting = make_plan<double>(both, ranges, plain, {}, 0.01, Solver::analytic);
    CHECK(plan.top == Approx(resting.top + 7));
    State<double> state = make_state(plan), still = make_state(resting);
    for (int k = 0; k < 120; ++k) advance(plan, state), advance(resting, still);
    CHECK((state.x_w[n] - both.joint_position[n] - Vec3(1, 7, 0)).norm() < 1e-12);
    CHECK(state.x_w[0] == both.joint_position[0]);
    scene.root_motion[0].tree = 2;
    CHECK_THROWS_AS(make_plan<double>(both, ranges, scene, {}, 0.01, Solver::analytic), std::out_of_range);
}

TEST_CASE("A run that is cut and gone on with is the run in one") {
    Scene scene;
    RootMotion m = root_keys();
    m.position[1] = Vec3(1, 0, 0);
    m.rotation[1] = make_tree::turn(1, Vec3::UnitY());
    scene.root_motion = {m};
    const Tree tree = make_tree::branched();
    PlainRun<double> whole(tree, scene), first(tree, scene), second(tree, scene);
    whole.steps(40);
    first.steps(17);
    second.state.theta = first.state.theta;
    second.state.theta_dot = first.state.theta_dot;
    parts::scaled_rate(second.state) = parts::scaled_rate(first.state);
    second.state.step = 17;
    move_ground(second.plan, second.state, double(second.state.step) * second.plan.dt);
    state_update(second.plan, second.state);
    second.steps(23);
    CHECK(state_hash(second.state) == state_hash(whole.state));
    CHECK(whole.largest_angle() > 1e-6);
}

TEST_CASE("Without root motion there is no ground") {
    const PlainRun<double> run(make_tree::branched(), Scene{});
    CHECK(run.state.ground.capacity() + parts::joints(run.state).root_load.capacity() + run.plan.splines.capacity() +
              run.plan.moved.capacity() ==
          0);
}
