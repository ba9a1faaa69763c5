// Trajectories of the articulated solvers: closed forms, conserved quantities, orders of convergence, what the reference
// says of its own error, and the same bits however a run is cut and shared out.
#include "lib/base/parallel.h"
#include "lib/study/articulated.h"
#include "lib/study/energy.h"
#include "lib/study/solvers.h"
#include "tests/support/integrate.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace solver;

namespace {

using std::numbers::pi;

struct RunInSteps {
    Plan<double> plan;
    State<double> state;
    RunInSteps(const Tree& tree, const Scene& scene, Solver solver, double dt, double tolerance = 1e-8)
        : plan(make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, dt, solver)), state(make_state(plan)) {
        parts::set_tolerance(plan, tolerance);
    }
    void set(std::size_t i, const Vec3& theta, const Vec3& rate) {
        state.theta[i] = theta;
        parts::scaled_rate(state)[i] = rate;
        state.theta_dot[i] = body_rate_jacobian_inverse(theta) * rate;
        state_update(plan, state);
    }
    void shake(double angle, double rate, unsigned seed = 3) {
        make_tree::Dice dice{std::mt19937(seed)};
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            const Vec3 theta = random_vector(dice, angle);
            set(i, theta, random_vector(dice, rate));
        }
    }
    void until(double time) {
        while (state.step < std::llround(time / plan.dt)) advance(plan, state);
    }
    double total_energy() const {
        const Energy e = energy(plan, state);
        return e.bodies + e.elastic + e.potential;
    }
};

// Of angles and of rates, the largest.
double distance(const State<double>& a, const State<double>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.theta.size(); ++i)
        most = std::max(
            {most, (a.theta[i] - b.theta[i]).norm(), (parts::scaled_rate(a)[i] - parts::scaled_rate(b)[i]).norm()});
    return most;
}

// One upright rod that turns about body x (world x): J theta'' = M(theta, theta').
struct Rod {
    Tree tree = make_tree::chain(1, 1, 0.02, 0.015);
    double m, c, J, K;
    explicit Rod(double stiffness, double damping = 0) : K(stiffness) {
        tree.stiffness[0] = Vec3(K, K, K);
        tree.damping[0] = damping;
        m = tree.mass[0];
        c = tree.com[0].z();
        J = tree.inertia[0](0, 0) + m * c * c;
    }
};

// Classical Runge-Kutta of order 4 for theta'' = a(theta, theta').
template <class F> std::pair<double, double> runge_kutta(F a, double x, double v, double time, int steps) {
    const double h = time / steps;
    for (int k = 0; k < steps; ++k) {
        const double v1 = v, a1 = a(x, v), v2 = v + h / 2 * a1, a2 = a(x + h / 2 * v1, v2);
        const double v3 = v + h / 2 * a2, a3 = a(x + h / 2 * v2, v3), v4 = v + h * a3, a4 = a(x + h * v3, v4);
        x += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return {x, v};
}

// Soft enough for explicit steps of a millisecond.
Tree soft_chain() {
    make_tree::Wood wood;
    wood.youngs = 2e6;
    wood.shear = 1e6;
    wood.damping = 0.02;
    return make_tree::chain(3, 1.2, 0.04, 0.03, 0.2, wood);
}

Scene windy() {
    Scene scene;
    scene.pose = Pose::rest;
    scene.wind = wind_preset("gusty");
    return scene;
}

// The order that errors at steps h, h/2, h/4 ... show: the last two's.
double order(const std::vector<double>& errors) {
    return std::log2(errors[errors.size() - 2] / errors.back());
}

double euler_order(Solver solver) {
    RunInSteps truth(soft_chain(), windy(), Solver::articulated_reference, 0.01, 1e-12);
    truth.shake(0.3, 1);
    truth.until(0.2);
    std::vector<double> errors;
    for (const double dt : {1e-4, 5e-5, 2.5e-5}) {
        RunInSteps run(soft_chain(), windy(), solver, dt);
        run.shake(0.3, 1);
        run.until(0.2);
        errors.push_back(distance(run.state, truth.state));
    }
    CAPTURE(errors);
    CHECK(errors[0] < 0.1);
    return order(errors);
}

} // namespace

TEST_CASE("a pendulum's quarter of a period at a large angle is the elliptic integral") {
    const Rod rod(0);
    Scene scene = empty_scene();
    scene.gravity = {0, -9.81, 0};
    const double from_hanging = GENERATE(0.1, 1.5, 2.6);
    const double k = std::sin(from_hanging / 2), omega = std::sqrt(rod.m * 9.81 * rod.c / rod.J);
    const auto integrand = [k](double p) { return 1 / std::sqrt(1 - k * k * std::sin(p) * std::sin(p)); };
    const double quarter = integrate(integrand, 0, pi / 2) / omega;
    // theta = pi hangs: turn the rod over, so that it hangs at 0.
    Tree tree = rod.tree;
    tree.joint_rotation[0] = make_tree::turn(pi / 2, Vec3::UnitX());
    RunInSteps run(tree, scene, Solver::articulated_reference, quarter / 8, 1e-11);
    run.set(0, Vec3(from_hanging, 0, 0), Vec3::Zero());
    run.until(quarter);
    CHECK(std::abs(run.state.theta[0].x()) < 1e-9);
    CHECK(std::abs(parts::scaled_rate(run.state)[0].x()) == Approx(2 * omega * k).epsilon(1e-9));
    run.until(2 * quarter);
    CHECK((run.state.theta[0] - Vec3(-from_hanging, 0, 0)).norm() < 1e-8);
    CHECK(run.state.flags.unresolved == 0);
}

TEST_CASE("a rod at large angles, with spring, damper, gravity and drag, is its scalar equation") {
    const Rod rod(30, 0.01);
    Scene scene = empty_scene();
    scene.gravity = {0, -9.81, 0};
    scene.wind = Wind{};
    RunInSteps run(rod.tree, scene, Solver::articulated_reference, 1.0 / 30, 1e-11);
    const double drag = run.plan.drag_area[0] * rod.c * rod.c * rod.c;
    const auto acceleration = [&](double x, double v) {
        const double spring = -rod.K * (x + 0.01 * v), weight = rod.m * 9.81 * rod.c * std::sin(x);
        return (spring + weight - drag * std::abs(v) * v) / rod.J;
    };
    run.set(0, Vec3(2.8, 0, 0), Vec3(-1, 0, 0));
    run.until(1);
    const auto [x, v] = runge_kutta(acceleration, 2.8, -1, 1, 40000);
    // The drag has a corner in its slope wherever the rod turns back.
    CHECK(std::abs(run.state.theta[0].x() - x) < 1e-7);
    CHECK(std::abs(parts::scaled_rate(run.state)[0].x() - v) < 1e-5);
}

TEST_CASE("a damped joint without load is its closed form, under, at and over critical damping") {
    const double K = 50;
    Rod rod(K);
    const double omega = std::sqrt(K / rod.J), ratio = GENERATE(0.05, 1.0, 4.0);
    rod.tree.damping[0] = 2 * ratio / omega;
    RunInSteps run(rod.tree, empty_scene(), Solver::articulated_reference, 1.0 / 30, 1e-11);
    run.set(0, Vec3(0, 1.2, 0), Vec3::Zero());
    run.until(0.5);
    const double g = ratio * omega, D = omega * omega - g * g, t = 0.5, s = std::sqrt(std::abs(D));
    const double even = D > 1e-9 ? std::cos(s * t) : D < -1e-9 ? std::cosh(s * t) : 1;
    const double odd = D > 1e-9 ? std::sin(s * t) / s : D < -1e-9 ? std::sinh(s * t) / s : t;
    const double x = 1.2 * std::exp(-g * t) * (even + g * odd), v = -1.2 * std::exp(-g * t) * omega * omega * odd;
    CHECK(std::abs(run.state.theta[0].y() - x) < 1e-9);
    CHECK(std::abs(parts::scaled_rate(run.state)[0].y() - v) < 1e-8);
}

TEST_CASE(
    "without springs, angular momentum about the root stays: all of it in free space, the vertical with gravity") {
    Tree tree = make_tree::chain(3, 1.5, 0.03, 0.02, 0.4);
    const bool gravity = GENERATE(false, true);
    Scene scene = empty_scene();
    if (gravity) scene.gravity = {0, -9.81, 0};
    scene.stiffness_scale = 0;
    RunInSteps run(tree, scene, Solver::articulated_reference, 0.02, 1e-10);
    run.plan.velocity = true;
    run.state.omega_w.resize(3);
    run.state.v_w.resize(3);
    run.shake(0.5, 2);
    const auto momentum = [&] {
        Vec3 L = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i) {
            const Mat3& R = run.state.R_wb[i];
            const Vec3 c = run.state.x_w[i] + R * tree.com[i];
            L += tree.mass[i] * c.cross(run.state.v_w[i]) + R * tree.inertia[i] * R.transpose() * run.state.omega_w[i];
        }
        return gravity ? Vec3(0, L.y(), 0) : L;
    };
    const Vec3 before = momentum();
    const double energy_before = run.total_energy();
    for (int k = 0; k < 50; ++k) {
        advance(run.plan, run.state);
        CHECK((momentum() - before).norm() < 1e-7 * before.norm());
    }
    CHECK(run.total_energy() == Approx(energy_before).epsilon(1e-7));
}

TEST_CASE("the energy of an undamped, windless tree stays, the better the smaller the tolerance") {
    Scene scene;
    scene.damping_scale = 0;
    Tree tree = make_tree::branched();
    for (std::size_t i = 10; i < tree.size_bodies(); ++i) tree.stiffness[i] *= 1e4; // leaves and fruit do not turn over
    std::vector<double> drifts;
    for (const double tolerance : {1e-6, 1e-8}) {
        RunInSteps run(tree, scene, Solver::articulated_reference, 1.0 / 30, tolerance);
        const double rest = run.total_energy();
        for (std::size_t i = 0; i < 4; ++i) run.state.theta[i] += Vec3(0.005, 0.002, 0.003); // the trunk, let go
        state_update(run.plan, run.state);
        const double start = run.total_energy();
        double drift = 0;
        for (int k = 0; k < 60; ++k) {
            advance(run.plan, run.state);
            drift = std::max(drift, std::abs(run.total_energy() - start) / (start - rest));
        }
        CHECK(run.state.flags.unresolved == 0);
        drifts.push_back(drift);
    }
    CHECK(drifts[0] < 1e-5);
    CHECK(drifts[1] < 1e-6);
    CHECK(drifts[1] < 0.5 * drifts[0]);
}

TEST_CASE("explicit Euler is first order") {
    CHECK(euler_order(Solver::articulated_explicit) == Approx(1).margin(0.05));
}

TEST_CASE("linearly implicit Euler is first order") {
    CHECK(euler_order(Solver::articulated_implicit) == Approx(1).margin(0.05));
}

TEST_CASE("the extrapolated step has the order of its table") {
    Scene scene = empty_scene();
    scene.gravity = {0, -9.81, 0};
    scene.pulls.push_back({});
    scene.pulls[0].on.body = 2;
    scene.pulls[0].time = {-1, 9};
    scene.pulls[0].force = {Vec3(1, 0, 2), Vec3(5, 3, 1)};
    scene.stiffness_scale = 0.05;
    RunInSteps truth(soft_chain(), scene, Solver::articulated_reference, 0.01, 1e-13);
    truth.shake(0.1, 0.5);
    truth.until(0.32);
    std::vector<double> errors;
    for (const double H : {0.08, 0.04, 0.02}) {
        RunInSteps run(soft_chain(), scene, Solver::articulated_reference, H, 1e300); // every step accepted, none cut
        run.shake(0.1, 0.5);
        run.until(0.32);
        CHECK(run.state.flags.inner_steps == std::uint64_t(run.state.step));
        errors.push_back(distance(run.state, truth.state));
    }
    CAPTURE(errors);
    CHECK(order(errors) > 7.5);
    CHECK(order(errors) < 9.5);
}

TEST_CASE("the reference's own estimate bounds its error: its distance to a run of a hundredth of the tolerance") {
    Scene scene = windy();
    scene.wind->profile = 0; // the field's table over height has corners
    const auto run_of = [&](double tolerance) {
        RunInSteps run(soft_chain(), scene, Solver::articulated_reference, 1.0 / 30, tolerance);
        run.shake(0.3, 1);
        run.until(1);
        CHECK(run.state.flags.unresolved == 0);
        return run.state;
    };
    const State<double> truth = run_of(1e-11);
    std::vector<double> errors;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
        const State<double> coarse = run_of(tolerance);
        errors.push_back(distance(coarse, truth));
        const double estimate = distance(coarse, run_of(tolerance / 100));
        CAPTURE(tolerance, errors.back(), estimate);
        CHECK(errors.back() < 1.5 * estimate);
        if (errors.size() > 1) CHECK(errors.back() < 0.2 * errors[errors.size() - 2]);
    }
}

TEST_CASE("a tolerance below rounding is counted, and comes to an end") {
    RunInSteps run(soft_chain(), windy(), Solver::articulated_reference, 1.0 / 30, 1e-20);
    run.shake(0.3, 1);
    run.until(1.0 / 3);
    CHECK(run.state.flags.unresolved > 0);
    CHECK(run.state.flags.inner_steps < 10000);
    RunInSteps truth(soft_chain(), windy(), Solver::articulated_reference, 1.0 / 30, 1e-11);
    truth.shake(0.3, 1);
    truth.until(1.0 / 3);
    CHECK(truth.state.flags.unresolved == 0);
    CHECK(distance(run.state, truth.state) < 1e-6);
}

TEST_CASE("an articulated run cut in two goes on as if it had not been") {
    for (const Solver solver : all_solvers) {
        if (!is_articulated(solver)) continue;
        CAPTURE(solver_name(solver));
        const double dt = solver == Solver::articulated_explicit ? 1e-4 : 1.0 / 30;
        RunInSteps whole(soft_chain(), windy(), solver, dt);
        whole.shake(0.3, 1);
        for (int k = 0; k < 5; ++k) advance(whole.plan, whole.state);
        RunInSteps resumed(soft_chain(), windy(), solver, dt);
        resumed.state.theta = whole.state.theta;
        resumed.state.theta_dot = whole.state.theta_dot;
        parts::scaled_rate(resumed.state) = parts::scaled_rate(whole.state);
        articulated_state(resumed.state).inner_step = articulated_state(whole.state).inner_step;
        resumed.state.step = whole.state.step;
        state_update(resumed.plan, resumed.state);
        for (int k = 0; k < 5; ++k) {
            advance(whole.plan, whole.state);
            advance(resumed.plan, resumed.state);
            CHECK(state_hash(whole.state) == state_hash(resumed.state));
        }
    }
}

TEST_CASE("on a steadily accelerated root, rest is where the analytic step has it at rest") {
    const Vec3 a(3, 1, -2);
    RootSpline spline;
    spline.position = QuinticSpline{{0, 1000}, {Vec3::Zero(), a * 5e5}, {Vec3::Zero(), a * 1000}, {a, a}};
    RootMotion keys;
    keys.time = {0, 1};
    keys.position.assign(2, Vec3::Zero());
    Scene scene;
    scene.pose = Pose::rest;
    scene.stiffness_scale = 0.1;
    scene.damping_scale = 10;
    scene.root_motion = {keys};
    const auto settled = [&](Solver solver, int steps) {
        RunInSteps run(make_tree::branched(), scene, solver, 1.0 / 30);
        run.plan.splines = {spline};
        for (int k = 0; k < steps; ++k) advance(run.plan, run.state);
        return run;
    };
    const RunInSteps analytic = settled(Solver::analytic, 15000),
                     implicit = settled(Solver::articulated_implicit, 15000);
    double most = 0, bend = 0;
    for (std::size_t i = 0; i < analytic.plan.bodies; ++i) {
        most = std::max(most, (analytic.state.theta[i] - implicit.state.theta[i]).norm());
        bend = std::max(bend, analytic.state.theta[i].norm());
    }
    CHECK(bend > 1e-3);
    CHECK(most < 1e-8);
    // The reference, started there, stays.
    RunInSteps run(make_tree::branched(), scene, Solver::articulated_reference, 1.0 / 30, 1e-9);
    run.plan.splines = {spline};
    run.state.theta = analytic.state.theta;
    for (int k = 0; k < 10; ++k) advance(run.plan, run.state);
    most = 0;
    for (std::size_t i = 0; i < run.plan.bodies; ++i)
        most = std::max(most, (analytic.state.theta[i] - run.state.theta[i]).norm());
    CHECK(most < 1e-7);
}

TEST_CASE("the number of threads does not change a bit of the reference") {
    const Tree tree = make_tree::random_tree(40, 4);
    std::uint64_t one_thread = 0;
    for (const int threads : {1, 2, 3, 8}) {
        const ThreadLimit limit(threads);
        RunInSteps run(tree, windy(), Solver::articulated_reference, 1.0 / 30, 1e-5);
        for (int k = 0; k < 3; ++k) advance(run.plan, run.state);
        if (threads == 1) {
            one_thread = state_hash(run.state);
            CHECK(run.state.theta_dot[20].norm() > 0);
        }
        CAPTURE(threads);
        CHECK(state_hash(run.state) == one_thread);
    }
}
