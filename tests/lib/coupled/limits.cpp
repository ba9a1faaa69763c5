// Joint limits of the coupled step: what stops at a limit loses the energy of a projection, and nothing else changes.
#include "lib/coupled/limits.h"
#include "lib/coupled/coupled_step.h"
#include "lib/plan/state_update.h"
#include "lib/study/energy.h"
#include "tests/support/paper_trees.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>
#include <random>

using namespace bough;

namespace {

// Of the bodies with these rates in the state's pose.
template <class T> double kinetic(const Plan<T>& plan, State<T> state, const std::vector<Vector3<T>>& rates) {
    state.theta_dot = rates;
    return energy(plan, state).bodies;
}

template <class T> void stops(double rounding) {
    const Tree tree = paper_trees::branched(2e8, 0.01);
    Scene scene;
    const Vec3 limit = Vec3::Constant(10);
    scene.joint_limit = JointLimit{limit, limit, limit};
    const Plan<T> plan =
        make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, Solver::coupled, Scheme::p12);
    State<T> state = make_state(plan);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto drawn = [&] { // one after another: a call's arguments have no order
        Vec3 v;
        for (int k = 0; k < 3; ++k) v[k] = normal(random);
        return v;
    };
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        state.theta[i] = (0.15 * drawn()).template cast<T>();
        state.theta_dot[i] = drawn().template cast<T>();
        for (int k = 0; k < 3; ++k)
            if (std::abs(state.theta[i][k]) > plan.theta_limit[i][k]) state.theta_dot[i][k] *= 20;
    }
    const std::vector<Vector3<T>> theta = state.theta, before = state.theta_dot;
    REQUIRE(keep_limits(plan, state, parts::bodies(state)));
    CHECK(state.flags.limited > 5);
    state_update(plan, state);
    std::vector<Vector3<T>> lost(plan.bodies);
    const T most = plan.theta_limit[0][0];
    std::size_t stopped = 0;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        lost[i] = before[i] - state.theta_dot[i];
        for (int k = 0; k < 3; ++k) {
            const bool past = std::abs(theta[i][k]) > most;
            CHECK(state.theta[i][k] == (past ? std::copysign(most, theta[i][k]) : theta[i][k]));
            if (!past || !(theta[i][k] * before[i][k] > 0)) continue;
            CHECK(state.theta_dot[i][k] == 0);
            ++stopped;
        }
    }
    CHECK(stopped > 5);
    // Pythagoras in the metric of the kinetic energy: what is lost stands at right angles on what is left.
    const double all = kinetic(plan, state, before);
    CHECK(kinetic(plan, state, state.theta_dot) + kinetic(plan, state, lost) == Approx(all).epsilon(rounding));
    // Joints further out swing on: a stop takes little, 0.4 % here, which float's lock of 1000 times the inertia does not resolve.
    if (sizeof(T) == 8) CHECK(kinetic(plan, state, lost) > 100 * rounding * all);
}

} // namespace

TEST_CASE("a limit stops what pushes on, by the projection that the kinetic energy knows, double") {
    stops<double>(1e-5);
}

TEST_CASE("a limit stops what pushes on, by the projection that the kinetic energy knows, float") {
    stops<float>(1e-2);
}

TEST_CASE("a run with limits keeps them, and one with limits far off is the run without") {
    const Tree tree = paper_trees::chain(2e7, 0.01);
    const std::vector<TreeRange> ranges{{0, tree.size_bodies(), 0}};
    Scene scene;
    scene.pose = Pose::rest;
    const auto run = [&](double degrees, double& most) {
        if (degrees > 0) {
            const Vec3 limit = Vec3::Constant(degrees);
            scene.joint_limit = JointLimit{limit, limit, limit};
        } else {
            scene.joint_limit.reset();
        }
        const Plan<double> plan = make_plan<double>(tree, ranges, scene, {}, 1.0 / 30, Solver::coupled, Scheme::p12);
        State<double> state = make_state(plan);
        double start = 0, highest = -1e300;
        for (int k = 0; k < 120; ++k) {
            advance(plan, state);
            const Energy e = energy(plan, state);
            if (k == 0) start = e.bodies + e.elastic + e.potential;
            highest = std::max(highest, e.bodies + e.elastic + e.potential - start);
            for (const Vec3& theta : state.theta) most = std::max(most, theta.cwiseAbs().maxCoeff());
        }
        CHECK(std::isfinite(highest));
        return state_hash(state);
    };
    double held = 0, loose = 0, none = 0;
    run(5, held);
    CHECK(held == Approx(5 * std::numbers::pi / 180).epsilon(1e-12));
    CHECK(run(179.9, loose) == run(0, none)); // it swings to 179.5 degrees
    CHECK(none > 5 * std::numbers::pi / 180);
}
