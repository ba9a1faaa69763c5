// The articulated-body pass against a dense solve of the same equations, its residual on large trees, its limits.
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/laws/wind.h"
#include "lib/model/wood.h"
#include "lib/study/articulated_step.h"
#include "lib/study/energy.h"
#include "lib/study/solvers.h"
#include "tests/support/dense_dynamics.h"
#include "tests/support/inverse_dynamics.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>
#include <iostream>

using namespace bough;
using namespace solver;

namespace {

struct Bench {
    Plan<double> plan;
    State<double> state;
    std::vector<Vec3> theta, rate;
    Bench(const Tree& tree, const Scene& scene, double angle, double speed, unsigned seed = 5,
          Solver solver = Solver::articulated_implicit)
        : plan(make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, solver)),
          state(make_state(plan)), theta(plan.bodies), rate(plan.bodies) {
        make_tree::Dice dice{std::mt19937(seed)};
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            theta[i] = random_vector(dice, angle);
            rate[i] = random_vector(dice, speed);
        }
    }
    ArticulatedPass& pass() { return articulated_state(state).pass[0]; }
    // d rate / dt, body axes: h = 0 of the equations, h > 0 of the linearly implicit step.
    std::vector<Vec3> accelerations(double time, double h = 0) {
        std::vector<Vec3> a;
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            pass().body[i].theta = theta[i];
            pass().body[i].rate = rate[i];
        }
        if (h > 0) pass().carried_drag = parts::carried_drag(plan);
        articulated_pass(plan, pass(), time, h);
        for (const ArticulatedBody& b : pass().body) a.push_back(b.rate_dot);
        return a;
    }
};

Pull pull_on(std::int64_t body, const Vec3& from, const Vec3& to) {
    Pull pull;
    pull.on.body = body;
    pull.time = {0, 2};
    pull.force = {from, to};
    return pull;
}

dense::Problem problem(const Tree& tree, const Bench& bench, double time, double h = 0) {
    dense::Problem p{tree, bench.plan, bench.theta, bench.rate};
    p.time = time;
    p.h = h;
    const Scene& scene = bench.plan.scene;
    p.air = scene.wind.has_value();
    if (p.air) p.wind = wind_velocity(*scene.wind, time + h).cast<dense::Real>();
    for (const auto& planned : bench.plan.pulls) {
        const Pull& pull = scene.pulls[planned.source];
        const double share = (time + h - pull.time[0]) / (pull.time[1] - pull.time[0]);
        p.pulls.push_back(((1 - share) * pull.force[0] + share * pull.force[1]).cast<dense::Real>());
    }
    return p;
}

// Largest difference over the joints, of the largest acceleration.
double difference(const std::vector<Vec3>& found, const dense::Solved& truth) {
    double worst = 0, size = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Vec3 expected = truth.rate_dot.segment<3>(3 * Eigen::Index(i)).cast<double>();
        worst = std::max(worst, (found[i] - expected).norm());
        size = std::max(size, expected.norm());
    }
    return worst / size;
}

double largest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}
double largest(const std::vector<Vec3>& a) {
    return largest(a, std::vector<Vec3>(a.size(), Vec3::Zero()));
}

struct Named {
    std::string name;
    Scene scene;
};

std::vector<Named> scenes() {
    Scene bare = empty_scene(), heavy = bare, blown = bare, pulled = bare, all;
    heavy.gravity = Vec3(1, -9.81, 2);
    blown.wind = wind_preset("gusty");
    blown.wind->profile = 0; // the dense solve has one wind everywhere
    pulled.pulls = {pull_on(3, Vec3(5, 0, -20), Vec3(-40, 3, 2)), pull_on(9, Vec3(0, 1, 0), Vec3(2, 1, 5))};
    all = blown;
    all.gravity = heavy.gravity;
    all.pulls = pulled.pulls;
    std::vector<Named> named{{"nothing", bare}, {"gravity", heavy}, {"wind", blown}, {"pulls", pulled}, {"all", all}};
    // Springs of wood drown all else; with soft ones, or none, the rest counts.
    for (Named& n : named) n.scene.stiffness_scale = 1e-7;
    named.push_back({"all, springs of wood", all});
    named.push_back({"all, no springs", all});
    named.back().scene.stiffness_scale = 0;
    named.push_back({"all, no damping", all});
    named.back().scene.damping_scale = 0;
    return named;
}

RootMotion two_keys() {
    RootMotion m;
    m.time = {0, 1};
    m.position.assign(2, Vec3::Zero());
    return m;
}

// The same motion for the pass and for the dense solve, from time 0 for two seconds.
RootSpline spline_of(const dense::GroundMotion& g) {
    const double T = 2;
    const Vec3 v = g.v.cast<double>(), a = g.a.cast<double>(), omega = g.omega.cast<double>();
    RootSpline s;
    s.position = QuinticSpline{{0, T}, {Vec3::Zero(), v * T + a * (T * T / 2)}, {v, v + a * T}, {a, a}};
    s.rotation = QuinticSpline{{0, T}, {Vec3::Zero(), omega * T}, {omega, omega}, {Vec3::Zero(), Vec3::Zero()}};
    s.pivot = g.pivot.cast<double>();
    return s;
}

Bench moved(const Tree& tree, Scene scene, const dense::GroundMotion& ground) {
    scene.root_motion = {two_keys()};
    Bench bench(tree, scene, 0.8, 2);
    bench.plan.splines = {spline_of(ground)};
    return bench;
}

Tree grown(int bodies) {
    const Splines splines = grow_bodies(default_growth(), 3, {true, false, true}, bodies);
    return segment(splines, *find_wood("northern-red-oak"), {});
}

} // namespace

TEST_CASE("accelerations are those of the dense solve by virtual work") {
    for (const Tree& tree : {make_tree::branched(), make_tree::random_tree(30, 4)})
        for (const Named& named : scenes()) {
            Bench bench(tree, named.scene, 0.8, 2);
            const std::vector<Vec3> a = bench.accelerations(0.7);
            CAPTURE(tree.name, named.name);
            CHECK(difference(a, dense::solve(problem(tree, bench, 0.7))) < 1e-10);
        }
}

TEST_CASE("the linearly implicit pass solves the system that it claims") {
    for (const Tree& tree : {make_tree::branched(), make_tree::random_tree(30, 4)})
        for (const Named& named : scenes())
            for (const double h : {1e-6, 1e-3, 1.0 / 30}) {
                Bench bench(tree, named.scene, 0.8, 1);
                const std::vector<Vec3> a = bench.accelerations(0.7, h);
                CAPTURE(tree.name, named.name, h);
                REQUIRE(bench.pass().fast == 0);
                CHECK(difference(a, dense::solve(problem(tree, bench, 0.7, h))) < 1e-10);
            }
}

TEST_CASE("on a ground that turns and is driven too") {
    dense::GroundMotion ground;
    ground.v = {3, -1, 2};
    ground.a = {4, 5, -6};
    ground.omega = {0.5, 2, -1};
    ground.pivot = {0.3, 0, -0.2};
    const Tree tree = make_tree::branched();
    Bench bench = moved(tree, scenes()[4].scene, ground);
    dense::Problem p = problem(tree, bench, 0.3);
    p.ground = ground;
    CHECK(difference(bench.accelerations(0.3), dense::solve(p)) < 1e-10);

    ground.omega.setZero(); // steadily accelerated: the mean acceleration of a step is the present one
    Bench driven = moved(tree, scenes()[4].scene, ground);
    dense::Problem implicit = problem(tree, driven, 0.3, 1.0 / 30);
    implicit.ground = ground;
    CHECK(difference(driven.accelerations(0.3, 1.0 / 30), dense::solve(implicit)) < 1e-10);
}

TEST_CASE("an accelerating ground is gravity tilted the other way, to rounding") {
    dense::GroundMotion ground;
    ground.v = {3, -1, 2};
    ground.a = {4, 5, -6};
    const Vec3 gravity(0, -9.81, 1);
    for (const double h : {0.0, 1.0 / 30}) {
        Scene scene = empty_scene();
        scene.stiffness_scale = 1e-7;
        scene.gravity = gravity;
        const Tree tree = make_tree::random_tree(30, 4);
        Bench carried = moved(tree, scene, ground);
        scene.gravity = gravity - ground.a.cast<double>();
        Bench tilted(tree, scene, 0.8, 2);
        const std::vector<Vec3> a = carried.accelerations(0.3, h), b = tilted.accelerations(0.3, h);
        CHECK(largest(a, b) < 1e-12 * largest(b));
        scene.gravity = gravity; // and it is no small thing
        CHECK(largest(Bench(tree, scene, 0.8, 2).accelerations(0.3, h), b) > 1e-3 * largest(b));
    }
}

TEST_CASE("the residual is what accelerations miss of the equations: M times their error") {
    const Tree tree = make_tree::branched();
    Bench bench(tree, scenes()[4].scene, 0.8, 2);
    const dense::Solved truth = dense::solve(problem(tree, bench, 0.7));
    make_tree::Dice dice{std::mt19937(9)};
    std::vector<Vec3> a;
    for (std::size_t i = 0; i < bench.plan.bodies; ++i)
        a.push_back(truth.rate_dot.segment<3>(3 * Eigen::Index(i)).cast<double>() + random_vector(dice, 10));
    dense::Vector error(truth.right.size());
    for (std::size_t i = 0; i < a.size(); ++i) error.segment<3>(3 * Eigen::Index(i)) = a[i].cast<dense::Real>();
    const dense::Vector missed = truth.M * error - truth.right;
    double squares = 0, worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double left = double(missed.segment<3>(3 * Eigen::Index(i)).norm());
        squares += left * left;
        worst = std::max(worst, left);
    }
    const Residual r = inverse_dynamics(bench.plan, bench.theta, bench.rate, a, 0.7);
    CHECK(r.rms == Approx(std::sqrt(squares / double(a.size()))).epsilon(1e-10));
    CHECK(r.worst == Approx(worst).epsilon(1e-10));
}

TEST_CASE("the residual stays at rounding from a hundred to a hundred thousand bodies") {
    struct Case {
        std::string name;
        Tree tree;
        double bound;
    };
    std::vector<Case> cases;
    for (const int n : {100, 1000, 10000, 100000}) {
        if (n <= 1000) cases.push_back({"random", make_tree::random_tree(n, 7), n == 100 ? 1e-12 : 3e-6});
        if (n >= 1000) cases.push_back({"grown", grown(n), n <= 10000 ? 1e-12 : INFINITY}); // cut finer than it is
        cases.push_back({"chain of rods", make_tree::chain(n, 0.1 * n, 0.05, 0.005), INFINITY});
        cases.push_back({"chain of discs", make_tree::chain(n, 10, 0.05, 0.005), INFINITY});
    }
    for (const double stiffness : {1.0, 0.0})
        for (const Case& c : cases) {
            Scene scene = empty_scene();
            scene.gravity = {0, -9.81, 0};
            scene.wind = wind_preset("gusty");
            scene.stiffness_scale = stiffness;
            Bench bench(c.tree, scene, 0.05, 0.5);
            std::vector<Vec3> a = bench.accelerations(1);
            const Residual r = inverse_dynamics(bench.plan, bench.theta, bench.rate, a, 1);
            CAPTURE(c.name, c.tree.size_bodies(), stiffness, r.rms, r.moment_rms);
            CHECK(r.moment_rms > 0);
            // (random: a thousand bodies with masses over ten decades; 7e-9 to 3e-7 were seen.)
            CHECK(r.relative() < c.bound);
            if (std::isfinite(c.bound)) continue;
            // In a long chain, or a tree of short pieces, no doubles do better: 16 roundings of the accelerations themselves miss as much.
            make_tree::Dice dice{std::mt19937(9)};
            for (Vec3& v : a)
                for (int k = 0; k < 3; ++k) v[k] *= 1 + dice(-16, 16) * 1.1e-16;
            const Residual rounded = inverse_dynamics(bench.plan, bench.theta, bench.rate, a, 1);
            CHECK(r.rms <= rounded.rms);
        }
}

TEST_CASE("a hair-thin twig under heavy fruit keeps its digits") {
    // Radii down to 0.02 mm and masses over seven decades.
    const Tree tree = make_tree::random_tree(100, 7);
    for (const double stiffness : {1.0, 1e-7, 0.0})
        for (const double h : {0.0, 1e-3, 1.0 / 30}) {
            Scene scene = scenes()[4].scene;
            scene.stiffness_scale = stiffness;
            Bench bench(tree, scene, 0.5, 0.5);
            CAPTURE(stiffness, h);
            CHECK(difference(bench.accelerations(0.7, h), dense::solve(problem(tree, bench, 0.7, h))) < 1e-8);
        }
}

TEST_CASE("the implicit pass tends to the plain one, by first order in h") {
    Bench bench(make_tree::branched(), scenes()[4].scene, 0.8, 2);
    bench.plan.scene.wind->turbulence = 0; // its time is the end of the step
    const std::vector<Vec3> plain = bench.accelerations(0.7);
    double before = 0;
    for (const double h : {1e-9, 5e-10, 2.5e-10}) {
        const double d = largest(bench.accelerations(0.7, h), plain);
        CHECK(d < 1e-2 * largest(plain));
        if (before > 0) CHECK(d / before == Approx(0.5).epsilon(0.02));
        before = d;
    }
}

TEST_CASE("bodies without radius, mass apart by 1e9, no spring at all: finite") {
    Tree tree = make_tree::branched();
    for (const std::size_t thin : {3, 5, 9}) {
        tree.inertia[thin] = Vec3(tree.inertia[thin](0, 0), tree.inertia[thin](0, 0), 0).asDiagonal();
        tree.stiffness[thin] = Vec3(1, 1, 0);
    }
    tree.mass[7] *= 1e-9; // a point on its own joint, with fruit on it
    tree.inertia[7].setZero();
    tree.stiffness[7].setZero();
    REQUIRE_FALSE(check(tree).has_value());
    for (const double stiffness : {1.0, 0.0}) {
        Scene scene = scenes()[4].scene;
        scene.stiffness_scale = stiffness;
        Bench bench(tree, scene, 0.5, 0.5);
        for (const double h : {0.0, 1e-9, 1e-3, 1.0 / 30, 1.0}) {
            CAPTURE(stiffness, h);
            for (const Vec3& a : bench.accelerations(0.7, h)) CHECK(a.allFinite());
        }
    }
}

TEST_CASE("turns of more than a radian in a step are bounded, counted, and give no energy") {
    // A free rod, spinning ten turns a step about a point with no gravity: nothing acts.
    Scene scene = empty_scene();
    scene.stiffness_scale = 0;
    Bench bench(make_tree::chain(2, 1, 0.02, 0.01), scene, 0.5, 0);
    bench.rate[0] = Vec3(600, 1800, 5);
    bench.rate[1] = Vec3(-1500, 20, 700);
    for (std::size_t i = 0; i < 2; ++i) {
        bench.state.theta[i] = bench.theta[i];
        parts::scaled_rate(bench.state)[i] = bench.rate[i];
        bench.state.theta_dot[i] = body_rate_jacobian_inverse(bench.theta[i]) * bench.rate[i];
    }
    state_update(bench.plan, bench.state);
    const double before = energy(bench.plan, bench.state).bodies;
    for (int k = 0; k < 300; ++k) advance(bench.plan, bench.state);
    CHECK(bench.state.flags.fast_turns > 300);
    CHECK_FALSE(first_non_finite(bench.state).has_value());
    CHECK(energy(bench.plan, bench.state).bodies < 1.01 * before);
}
