// The error that a run tells of itself, against the one it has.
#include "lib/reference/advance.h"
#include "lib/reference/error_estimate.h"
#include "lib/reference/trajectory.h"
#include "lib/stages/state_update.h"
#include "tests/paper_trees.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;

namespace {

constexpr double pi = std::numbers::pi;

// Damping ratio 0.03 of the first mode, which is at 1.05 Hz (chain) and 3.6 Hz (branched) at 2e9 Pa.
Tree rods(bool forked, double E) {
    const double beta = 0.06 / (2 * pi * (forked ? 3.6 : 1.05) * std::sqrt(E / 2e9));
    return forked ? paper_trees::branched(E, beta) : paper_trees::chain(E, beta);
}

Scene let_go() {
    Scene scene;
    scene.pose = Pose::rest;
    return scene;
}

Scene in_wind(const char* name = "gusty") {
    Scene scene;
    scene.wind = wind_preset(name);
    return scene;
}

Scene shaken() {
    Scene scene;
    RootMotion motion;
    for (int k = 0; k <= 40; ++k) {
        motion.time.push_back(0.05 * k);
        motion.position.push_back(Vec3(0.05 * std::min(1.0, 0.1 * k) * std::sin(2 * pi * 0.05 * k), 0, 0));
    }
    scene.root_motion.push_back(motion);
    return scene;
}

std::vector<TreeRange> range_of(const Tree& tree) {
    return {{0, tree.size_bodies(), 0}};
}

template <class T = double>
Plan<T> planned(const Tree& tree, const Scene& scene, Solver solver, double dt, Scheme scheme = Scheme::p12) {
    return make_plan<T>(tree, range_of(tree), scene, {}, dt, solver, scheme);
}

// frames of `substeps` steps, followed by the estimate.
template <class T>
TipError estimated(const Tree& tree, const Plan<T>& plan, State<T>& state, int frames, int substeps) {
    ErrorEstimate<T> estimate(tree, plan, state);
    for (int f = 0; f < frames; ++f) {
        for (int k = 0; k < substeps; ++k) advance(plan, state);
        estimate.follow(state);
    }
    return estimate.result();
}

struct Difference {
    double rms, worst;
};

// Of tips at the frames that both have, the start left out.
Difference difference(const Trajectory& a, const Trajectory& b) {
    const std::int64_t stride = std::max(a.stride, b.stride);
    double squares = 0, worst = 0;
    std::size_t count = 0;
    for (std::int64_t f = stride; std::size_t(f / a.stride) < a.tip.size() && std::size_t(f / b.stride) < b.tip.size();
         f += stride)
        for (std::size_t k = 0; k < a.tip[0].size(); ++k, ++count) {
            const double d = (a.tip[std::size_t(f / a.stride)][k] - b.tip[std::size_t(f / b.stride)][k]).norm();
            squares += d * d;
            worst = std::max(worst, d);
        }
    return {std::sqrt(squares / double(count)), worst};
}

} // namespace

TEST_CASE("the estimate is of the size of the error, against the reference") {
    struct Case {
        const char* name;
        bool forked;
        double E;
        Scene scene;
        Scheme scheme;
        int substeps;
        double most; // estimate / error
    };
    const auto p12 = Scheme::p12;
    for (const Case& c : {Case{"soft chain, gravity switched on", false, 2e8, let_go(), p12, 1, 9.6},
                          Case{"soft chain, gravity switched on, fine", false, 2e8, let_go(), p12, 4, 3.5},
                          Case{"soft chain, wind", false, 2e8, in_wind(), p12, 1, 7},
                          Case{"soft chain, storm", false, 2e8, in_wind("storm"), p12, 4, 7},
                          Case{"soft chain, shaken", false, 2e8, shaken(), p12, 2, 7},
                          Case{"chain, gravity switched on", false, 2e9, let_go(), p12, 1, 7},
                          Case{"branched, wind", true, 2e9, in_wind(), p12, 1, 7},
                          Case{"branched, gravity switched on", true, 2e9, let_go(), p12, 2, 7},
                          Case{"branched, shaken", true, 2e8, shaken(), p12, 1, 7},
                          Case{"stiff branched, wind", true, 2e10, in_wind(), p12, 4, 7},
                          Case{"soft chain, wind, LIE", false, 2e8, in_wind(), Scheme::lie, 4, 1.2}}) {
        CAPTURE(c.name);
        const Tree tree = rods(c.forked, c.E);
        const std::vector<TreeRange> ranges = range_of(tree);
        const Problem problem{tree, ranges, c.scene, 30, 61};
        const Trajectory truth = run_trajectory(problem, {.solver = Solver::articulated_reference}, false, 1, [] {}),
                         run = run_trajectory(
                             problem,
                             {.solver = Solver::coupled, .steps_per_frame = double(c.substeps), .scheme = c.scheme},
                             false, 1, [] {});
        REQUIRE(truth.flags.unresolved == 0);
        const Difference error = difference(run, truth);
        const Plan<double> plan = planned(tree, c.scene, Solver::coupled, 1.0 / 30 / c.substeps, c.scheme);
        State<double> state = make_state(plan);
        const TipError e = estimated(tree, plan, state, 60, c.substeps);
        CHECK(state_hash(state) == run.hash); // being followed changes nothing
        CHECK(e.resolved());
        CHECK(e.rms > 0.7 * error.rms);
        CHECK(e.rms < c.most * error.rms);
        CHECK(e.worst > 0.55 * error.worst);
        CHECK(e.worst < 1.3 * c.most * error.worst);
    }
}

TEST_CASE("the estimate is the difference of two runs, one at twice the step") {
    for (const bool moved : {false, true}) {
        const Tree tree = rods(true, 2e9);
        Scene scene = moved ? shaken() : in_wind();
        const std::vector<TreeRange> ranges = range_of(tree);
        const Problem problem{tree, ranges, scene, 30, 62}; // 61 steps: the last frame has no companion
        const Variant fine{.solver = Solver::coupled, .steps_per_frame = 1},
            coarse{.solver = Solver::coupled, .steps_per_frame = 0.5};
        const Trajectory run = run_trajectory(problem, fine, false, 1, [] {});
        const Difference d = difference(run, run_trajectory(problem, coarse, false, 1, [] {}));
        double squares = 0;
        for (std::size_t f = 2; f < 62; f += 2)
            for (std::size_t k = 0; k < 3; ++k) squares += (run.tip[f][k] - run.tip[0][k]).squaredNorm();
        const Plan<double> plan = planned(tree, scene, Solver::coupled, 1.0 / 30);
        State<double> state = make_state(plan);
        const TipError e = estimated(tree, plan, state, 61, 1);
        CHECK(e.samples == 30);
        CHECK(e.tips == 3);
        CHECK(e.rms == Approx(d.rms).epsilon(1e-12));
        CHECK(e.worst == Approx(d.worst).epsilon(1e-12));
        CHECK(e.deflection == Approx(std::sqrt(squares / 90)).epsilon(1e-12));
        if (moved) CHECK(e.deflection < 0.01); // the ground goes 50 mm to and fro
        // The same in float, but for its rounding.
        const Plan<float> single = planned<float>(tree, scene, Solver::coupled, 1.0 / 30);
        State<float> in_float = make_state(single);
        CHECK(estimated(tree, single, in_float, 61, 1).rms == Approx(d.rms).epsilon(1e-3));
    }
}

TEST_CASE("frames are compared where they end an even number of steps") {
    const Tree tree = rods(false, 2e9);
    for (const auto& [substeps, samples] : {std::pair{1, 5}, std::pair{2, 10}, std::pair{3, 5}, std::pair{4, 10}}) {
        const Plan<double> plan = planned(tree, in_wind(), Solver::coupled, 1.0 / 30 / substeps);
        State<double> state = make_state(plan);
        CHECK(estimated(tree, plan, state, 10, substeps).samples == samples);
    }
}

// From a state on the way: the error counted is what comes from there on, against a reference that starts from it too.
// The last run is short: a companion that took its first step as one from rest would be off by 6 errors.
TEST_CASE("a run that goes on from a saved state has the error that it makes from there") {
    struct Case {
        bool forked;
        double E;
        Scene scene;
        int before, frames; // steps before; after an odd number the companion joins one later
        double most;        // estimate / error
    };
    for (const Case& c : {Case{false, 2e8, in_wind(), 30, 30, 7}, Case{false, 2e8, in_wind(), 31, 30, 7},
                          Case{true, 2e8, in_wind(), 31, 30, 7}, Case{false, 2e9, let_go(), 30, 8, 4}}) {
        CAPTURE(c.forked, c.before);
        const Tree tree = rods(c.forked, c.E);
        const double dt = 1.0 / 60;
        const Plan<double> plan = planned(tree, c.scene, Solver::coupled, dt),
                           exact = planned(tree, c.scene, Solver::articulated_reference, dt);
        State<double> state = make_state(plan), truth = make_state(exact);
        for (int k = 0; k < c.before; ++k) advance(plan, state);
        ErrorEstimate<double> estimate(tree, plan, state);
        for (; state.step % 2 != 0; estimate.follow(state)) advance(plan, state);
        truth.theta = state.theta;
        truth.theta_dot = state.theta_dot;
        for (std::size_t i = 0; i < truth.theta.size(); ++i)
            truth.scaled_rate[i] = body_rate_jacobian(truth.theta[i]) * truth.theta_dot[i];
        truth.step = state.step;
        state_update(exact, truth);
        double squares = 0;
        std::size_t count = 0;
        for (int f = 0; f < c.frames; ++f) {
            for (int k = 0; k < 2; ++k) {
                advance(plan, state);
                advance(exact, truth);
            }
            estimate.follow(state);
            for (const std::size_t i : tip_bodies(tree)) {
                squares += (tip_position(plan, state, tree, i) - tip_position(exact, truth, tree, i)).squaredNorm();
                ++count;
            }
        }
        const TipError e = estimate.result();
        CHECK(e.samples == c.frames);
        CHECK(e.rms > 0.7 * std::sqrt(squares / double(count)));
        CHECK(e.rms < c.most * std::sqrt(squares / double(count)));
    }
}

TEST_CASE("what a step is too coarse for, or cannot run, is not resolved") {
    const Tree tree = rods(true, 2e10);
    const Plan<double> plan = planned(tree, shaken(), Solver::coupled, 1.0 / 30);
    State<double> state = make_state(plan);
    const TipError e = estimated(tree, plan, state, 60, 1);
    CHECK(e.finite);
    CHECK_FALSE(e.resolved());

    State<double> broken = make_state(plan);
    broken.theta_dot[3].x() = NAN; // the companion's start
    ErrorEstimate<double> estimate(tree, plan, broken);
    State<double> whole = make_state(plan);
    for (int k = 0; k < 4; ++k) {
        advance(plan, whole);
        estimate.follow(whole);
    }
    CHECK_FALSE(estimate.result().finite);
    CHECK_FALSE(estimate.result().resolved());
    CHECK(estimate.result().samples == 0);
}
