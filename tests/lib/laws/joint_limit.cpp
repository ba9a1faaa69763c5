// Joint limits against what a rigid stop does: it holds, it lets go, it takes energy and gives none.
#include "lib/laws/joint_limit.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include "tests/support/solver_parts.h"
#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace bough;
using namespace simulate;

namespace {

constexpr double degree = std::numbers::pi / 180;

JointLimit all(double degrees) {
    const Vec3 most = Vec3::Constant(degrees);
    return {most, most, most};
}

// A rod that lies level, on a spring far too soft to carry it: it falls.
Tree lying_rod(double youngs = 1e4, double beta = 0) {
    make_tree::Wood wood;
    wood.youngs = youngs;
    wood.shear = youngs / 10;
    wood.damping = beta;
    Tree tree = make_tree::chain(1, 1, 0.02, 0.02, 0, wood);
    tree.joint_rotation[0] = Quat::Identity(); // z along the world's z
    return tree;
}

Scene falling() {
    Scene scene;
    scene.pose = Pose::rest;
    return scene;
}

template <class T> void shake(PlainRun<T>& run, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const double share = size / std::sqrt(double(run.state.theta.size()));
    for (auto& w : parts::scaled_rate(run.state))
        w = (share * Vec3(normal(random), normal(random), normal(random))).template cast<T>();
}

// How far beyond its limit the furthest angle is [rad].
template <class T> double excess(const PlainRun<T>& run) {
    double most = -1e9;
    for (std::size_t i = 0; i < run.plan.bodies; ++i)
        most = std::max(most, double((run.state.theta[i].cwiseAbs() - run.plan.theta_limit[i]).maxCoeff()));
    return most;
}

std::string refusal(const Tree& tree, const Scene& scene, Solver solver = Solver::analytic) {
    try {
        make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, solver);
    } catch (const std::domain_error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEMPLATE_TEST_CASE("a rod falls onto its limit and rests there", "", float, double) {
    Scene scene = falling();
    scene.joint_limit = all(30);
    PlainRun<TestType> run(lying_rod(), scene), unlimited(lying_rod(), falling());
    double furthest = 0;
    for (int k = 0; k < 60; ++k) {
        run.steps(1);
        CHECK(excess(run) <= 1e-12);
    }
    unlimited.steps(5);
    for (int k = 0; k < 60; ++k) {
        unlimited.steps(1);
        furthest = std::max(furthest, unlimited.largest_angle());
    }
    CHECK(furthest > 90 * degree);
    // The axis that gravity turns it about is x: down is a positive turn of z = +z.
    CHECK(double(run.state.theta[0].x()) == Approx(30 * degree).epsilon(1e-6));
    CHECK(double(run.state.theta[0].tail(2).norm()) < 1e-6);
    CHECK(double(run.state.theta_dot[0].norm()) < (std::is_same_v<TestType, float> ? 1e-5 : 1e-12));
    CHECK(run.state.flags.limited > 40);
    CHECK(unlimited.state.flags.limited == 0);
}

TEST_CASE("a rod that gravity no longer holds swings back from its limit as one that starts there") {
    Scene scene = falling();
    scene.joint_limit = all(30);
    PlainRun<double> run(lying_rod(1e7, 0.02), scene);
    run.steps(60);
    Scene free = nothing();
    PlainRun<double> fresh(lying_rod(1e7, 0.02), free);
    fresh.state.theta[0] = Vec3(30 * degree, 0, 0);
    state_update(fresh.plan, fresh.state);
    free.joint_limit = all(30);
    PlainRun<double> released(lying_rod(1e7, 0.02), free);
    released.state.theta = run.state.theta;
    released.state.theta_dot = run.state.theta_dot;
    parts::scaled_rate(released.state) = parts::scaled_rate(run.state);
    state_update(released.plan, released.state);
    for (int k = 0; k < 40; ++k) {
        released.steps(1);
        fresh.steps(1);
        CAPTURE(k);
        CHECK((released.state.theta[0] - fresh.state.theta[0]).norm() <= 1e-12);
        CHECK((released.state.theta_dot[0] - fresh.state.theta_dot[0]).norm() <= 1e-11);
    }
    CHECK(released.state.flags.limited == 0);
    CHECK(fresh.state.theta[0].x() < 29 * degree);
}

TEST_CASE("limits take energy from a shaken tree and give it none") {
    const unsigned seed = GENERATE(1u, 2u, 3u);
    const JointInertia inertia = GENERATE(JointInertia::branch, JointInertia::paper);
    const double stiffness = GENERATE(1e-4, 1e-2, 1.0);
    CAPTURE(seed, stiffness);
    Scene scene = nothing();
    scene.joint_limit = all(5);
    scene.damping_scale = 0;
    scene.stiffness_scale = stiffness;
    scene.joint_inertia = inertia;
    PlainRun<double> run(make_tree::branched(), scene);
    shake(run, 3, seed);
    const double first = run.total_energy();
    double before = first, rise = 0;
    for (int k = 0; k < 300; ++k) {
        run.steps(1);
        CHECK(excess(run) <= 0);
        const double now = run.total_energy();
        rise = std::max(rise, now - before);
        before = now;
    }
    CHECK(rise <= 1e-12 * first);
    CHECK(before < 0.9 * first);
    CHECK(run.state.flags.limited > 10);
}

TEST_CASE("a stop takes the rates that push on, by the least change of w, and what is carried agrees with theta_dot") {
    // Angles against a clamp, rates against C w with C by a general inverse, one held component against the perpendicular.
    std::mt19937 engine(5);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Vec3(normal(engine), normal(engine), normal(engine)); };
    int stopped = 0, several = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Mat3 B = Mat3::Random(), S = B * B.transpose() + 0.01 * Mat3::Identity();
        const Mat3 L = S.llt().matrixL();
        const Vec3 limit(0.3, 0.5, 0.2), start = 0.5 * vector(), w0 = vector();
        Vec3 theta = start, w = w0;
        const bool stops = stop_at_limit(limit, L, theta, w);
        CHECK(stops == ((start.cwiseAbs() - limit).maxCoeff() > 0));
        CHECK(theta == Vec3(start.cwiseMin(limit).cwiseMax(-limit)));
        if (!stops) {
            CHECK(w == w0);
            continue;
        }
        ++stopped;
        const Mat3 C = body_rate_jacobian_inverse(theta) * L.transpose().inverse(); // theta_dot = C w
        const Vec3 before = C * w0, after = C * w;
        CHECK(w.norm() <= w0.norm() * (1 + 1e-14));
        std::vector<int> held;
        for (int k = 0; k < 3; ++k) {
            if (!(std::abs(start[k]) > limit[k])) continue;
            CHECK(after[k] * start[k] <= 1e-9 * C.row(k).norm()); // none pushes on
            if (before[k] * start[k] > 0) held.push_back(k);
        }
        several += held.size() > 1;
        if (held.empty()) CHECK(w == w0);
        // One constraint in all: the foot of the perpendicular.
        if ((start.cwiseAbs() - limit).cwiseMax(0).cwiseSign().sum() == 1 && held.size() == 1) {
            const Vec3 c = C.row(held[0]).transpose();
            CHECK((w - (w0 - c * (c.dot(w0) / c.squaredNorm()))).norm() <= 1e-10 * w0.norm());
        }
    }
    CHECK(stopped > 500);
    CHECK(several > 50);
}

TEMPLATE_TEST_CASE("a limit that is never reached changes no bit and no array", "", float, double) {
    const Tree tree = make_tree::branched();
    Scene scene = nothing();
    scene.wind = steady(1);
    PlainRun<TestType> without(tree, scene);
    scene.joint_limit = all(170);
    PlainRun<TestType> with(tree, scene);
    CHECK(without.plan.theta_limit.capacity() == 0);
    CHECK_FALSE(without.plan.joint_limit);
    CHECK(with.plan.theta_limit.size() == tree.size_bodies());
    for (PlainRun<TestType>* run : {&without, &with}) run->steps(50);
    CHECK(without.largest_angle() > 1e-3);
    CHECK(without.largest_angle() < 170 * degree);
    CHECK(with.state.flags.limited == 0);
    CHECK(state_hash(with.state) == state_hash(without.state));
    CHECK(with.state.bytes() == without.state.bytes());
    CHECK(with.state.calls == without.state.calls);
    REQUIRE(explain(with.plan).stages.size() == explain(without.plan).stages.size());
    for (std::size_t k = 0; k < explain(with.plan).stages.size(); ++k) {
        const bool spring = explain(with.plan).stages[k].stage == Stage::spring;
        CHECK(explain(with.plan).stages[k].on == explain(without.plan).stages[k].on);
        CHECK((explain(with.plan).stages[k].reason != explain(without.plan).stages[k].reason) == spring);
        if (!spring) continue;
        CHECK(explain(with.plan).stages[k].reason == "every scene; angles kept within /joint_limit");
        CHECK(explain(without.plan).stages[k].reason == "every scene");
    }
}

TEMPLATE_TEST_CASE("a limited run cut in two goes on as if it had not been", "", float, double) {
    Scene scene = falling();
    scene.joint_limit = all(2);
    scene.wind = wind_preset("storm");
    PlainRun<TestType> whole(make_tree::branched(), scene), second(make_tree::branched(), scene);
    whole.steps(30);
    CHECK(whole.state.flags.limited > 0);
    second.state.theta = whole.state.theta;
    second.state.theta_dot = whole.state.theta_dot;
    parts::scaled_rate(second.state) = parts::scaled_rate(whole.state);
    second.state.step = whole.state.step;
    state_update(second.plan, second.state);
    whole.steps(30);
    second.steps(30);
    CHECK(state_hash(whole.state) == state_hash(second.state));
}

TEST_CASE("limits are by kind and axis, and 180 degrees is none") {
    Scene scene = nothing();
    scene.joint_limit = JointLimit{Vec3(10, 20, 180), Vec3::Constant(180), Vec3(1, 2, 3)};
    Tree tree = make_tree::branched();
    const PlainRun<double> run(tree, scene);
    constexpr double none = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3 expected = tree.kind[i] == Kind::branch  ? Vec3(10 * degree, 20 * degree, none)
                              : tree.kind[i] == Kind::fruit ? Vec3(degree, 2 * degree, 3 * degree)
                                                            : Vec3::Constant(none);
        for (int k = 0; k < 3; ++k)
            CHECK((run.plan.theta_limit[i][k] == expected[k] ||
                   run.plan.theta_limit[i][k] == Approx(expected[k]).epsilon(1e-15)));
    }
}

TEST_CASE("what limits cannot do is refused with its place") {
    // A rod that leans: bent, where it is drawn in equilibrium.
    Tree tree = make_tree::chain(3, 3, 0.01, 0.01);
    tree.joint_rotation[0] = make_tree::turn(0.5, Vec3::UnitX()) * tree.joint_rotation[0];
    Scene scene;
    const PlainRun<double> drawn(tree, scene);
    const double start = drawn.plan.theta_start[0].cwiseAbs().maxCoeff() / degree;
    REQUIRE(start > 0.1);
    scene.joint_limit = all(0.9 * start);
    CHECK(refusal(tree, scene).rfind("joint_limit: body 0 (branch 0) starts ", 0) == 0);
    scene.joint_limit = all(1.1 * start);
    CHECK(refusal(tree, scene) == "");
    for (const Solver solver : all_solvers) CHECK((refusal(tree, scene, solver) == "") == !is_articulated(solver));
    CHECK(refusal(tree, scene, Solver::articulated_implicit) ==
          "joint_limit: only the coupled and the analytic solver keep limits, not articulated-implicit");
    scene.joint_limit = std::nullopt;
    CHECK(refusal(tree, scene, Solver::articulated_implicit) == "");
}
