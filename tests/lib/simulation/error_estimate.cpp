// The error that a run tells of itself, against the one it has.
#include "lib/simulation/error_estimate.h"
#include "lib/plan/state_update.h"
#include "lib/study/solvers.h"
#include "lib/study/trajectory_difference.h"
#include "tests/support/paper_trees.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;

namespace {

using std::numbers::pi;

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

Trajectory ran(const Tree& tree, const Scene& scene, const Variant& how, double fps = 30, std::int64_t frames = 61) {
    const std::vector<TreeRange> ranges = range_of(tree);
    return run_trajectory({tree, ranges, scene, fps, frames}, how, false, 1, [] {});
}

// At the start, or as another run left it.
State<double> exact_from(const Plan<double>& exact, const State<double>& run) {
    State<double> truth = make_state(exact);
    truth.theta = run.theta;
    truth.theta_dot = run.theta_dot;
    for (std::size_t i = 0; i < truth.theta.size(); ++i)
        parts::scaled_rate(truth)[i] = body_rate_jacobian(truth.theta[i]) * truth.theta_dot[i];
    truth.step = run.step;
    state_update(exact, truth);
    return truth;
}

struct Case {
    const char* name;
    bool forked;
    double E;
    Scene scene;
    Scheme scheme;
    int substeps;
};

} // namespace

TEST_CASE("the estimate is never far below the error and within a factor of it, against the reference") {
    const auto p12 = Scheme::p12;
    for (const Case& c :
         cases(3, {Case{"soft chain, gravity switched on", false, 2e8, let_go(), p12, 1},
                   Case{"soft chain, gravity switched on, fine", false, 2e8, let_go(), p12, 4},
                   Case{"soft chain, wind", false, 2e8, in_wind(), p12, 1},
                   Case{"soft chain, storm", false, 2e8, in_wind("storm"), p12, 4},
                   Case{"soft chain, shaken", false, 2e8, shaken(), p12, 2},
                   Case{"chain, gravity switched on", false, 2e9, let_go(), p12, 1},
                   Case{"branched, wind", true, 2e9, in_wind(), p12, 1},
                   Case{"branched, gravity switched on", true, 2e9, let_go(), p12, 2},
                   Case{"branched, shaken", true, 2e8, shaken(), p12, 1},
                   Case{"branched, shaken, 3.6 Hz", true, 2e9, shaken(), p12, 1},
                   Case{"stiff branched, wind", true, 2e10, in_wind(), p12, 4},
                   // too coarse for the run: 17 to 35 % of what the tips move
                   Case{"stiff branched, wind, coarse", true, 2e10, in_wind(), p12, 1},
                   Case{"stiff branched, gravity switched on, coarse", true, 2e10, let_go(), p12, 1},
                   Case{"stiff branched, shaken, coarse", true, 2e10, shaken(), p12, 1},
                   Case{"soft chain, wind, LIE", false, 2e8, in_wind(), Scheme::lie, 4},
                   Case{"branched, gravity switched on, LIE", true, 2e9, let_go(), Scheme::lie, 1},
                   Case{"stiff branched, wind, LIE", true, 2e10, in_wind(), Scheme::lie, 2},
                   Case{"branched, wind, P.5", true, 2e9, in_wind(), Scheme::p50, 1},
                   Case{"stiff branched, gravity switched on, P34", true, 2e10, let_go(), Scheme::p34, 2}})) {
        CAPTURE(c.name);
        const Tree tree = rods(c.forked, c.E);
        const Trajectory truth = ran(tree, c.scene, {.solver = Solver::articulated_reference}),
                         run = ran(
                             tree, c.scene,
                             {.solver = Solver::coupled, .steps_per_frame = double(c.substeps), .scheme = c.scheme});
        REQUIRE(truth.flags.unresolved == 0);
        const Distance error = distance(run, truth);
        const Plan<double> plan = planned(tree, c.scene, Solver::coupled, 1.0 / 30 / c.substeps, c.scheme);
        State<double> state = make_state(plan);
        const TipError e = estimated(tree, plan, state, 60, c.substeps);
        CHECK(state_hash(state) == run.hash); // being followed changes nothing
        CHECK(e.known());
        CHECK(e.rms > error.rms);
        CHECK(e.rms < 1.6 * error.rms);
        CHECK(e.worst > error.most);
        CHECK(e.worst < 1.8 * error.most);
    }
}

TEST_CASE("the estimate is 3/2 of the difference of two runs, one at a quarter of the step") {
    for (const bool moved : {false, true}) {
        const Tree tree = rods(true, 2e9);
        const Scene scene = moved ? shaken() : in_wind();
        const Variant each{.solver = Solver::coupled}, four{.solver = Solver::coupled, .steps_per_frame = 4};
        const Trajectory run = ran(tree, scene, each);
        const Distance d = distance(run, ran(tree, scene, four));
        const Plan<double> plan = planned(tree, scene, Solver::coupled, 1.0 / 30);
        State<double> state = make_state(plan);
        const TipError e = estimated(tree, plan, state, 60, 1);
        CHECK(e.samples == 60);
        CHECK(e.tips == 3);
        CHECK(e.rms == Approx(1.5 * d.rms).epsilon(1e-12));
        CHECK(e.worst == Approx(1.5 * d.most).epsilon(1e-12));
        CHECK(e.deflection == Approx(deflection(run.tip).rms).epsilon(1e-12));
        if (moved) CHECK(e.deflection < 0.01); // the ground goes 50 mm to and fro

        // Fourth differences of the companion's tips from step to step.
        Points tip = ran(tree, scene, each, 120, 241).tip;
        for (std::size_t order = 1; order <= 4; ++order)
            for (std::size_t f = tip.size(); f-- > order;)
                for (std::size_t k = 0; k < 3; ++k) tip[f][k] -= tip[f - 1][k];
        double squares = 0;
        for (std::size_t f = 4; f < tip.size(); ++f)
            for (const Vec3& x : tip[f]) squares += x.squaredNorm();
        CHECK(e.rough == Approx(std::sqrt(squares / (237 * 3))).epsilon(1e-8));

        // The same in float, but for its rounding.
        const Plan<float> single = planned<float>(tree, scene, Solver::coupled, 1.0 / 30);
        State<float> in_float = make_state(single);
        CHECK(estimated(tree, single, in_float, 60, 1).rms == Approx(e.rms).epsilon(1e-3));
    }
}

TEST_CASE("each frame is compared, whatever the number of steps") {
    const Tree tree = rods(false, 2e9);
    for (const int substeps : {1, 2, 3, 4}) {
        const Plan<double> plan = planned(tree, in_wind(), Solver::coupled, 1.0 / 30 / substeps);
        State<double> state = make_state(plan);
        CHECK(estimated(tree, plan, state, 10, substeps).samples == 10);
    }
}

// From a state on the way: the error counted is what comes from there on, against a reference that starts from it too.
// The last run is short: a companion that took its first step as one from rest would be off.
TEST_CASE("a run that goes on from a saved state has the error that it makes from there") {
    struct Part {
        bool forked;
        double E;
        Scene scene;
        int before, frames; // steps before
    };
    for (const Part& c : {Part{false, 2e8, in_wind(), 30, 30}, Part{false, 2e8, in_wind(), 31, 30},
                          Part{true, 2e8, in_wind(), 31, 30}, Part{false, 2e9, let_go(), 30, 8}}) {
        CAPTURE(c.forked, c.before);
        const Tree tree = rods(c.forked, c.E);
        const double dt = 1.0 / 60;
        const Plan<double> plan = planned(tree, c.scene, Solver::coupled, dt),
                           exact = planned(tree, c.scene, Solver::articulated_reference, dt);
        State<double> state = make_state(plan);
        for (int k = 0; k < c.before; ++k) advance(plan, state);
        State<double> truth = exact_from(exact, state);
        ErrorEstimate<double> estimate(tree, plan, state);
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
        const double error = std::sqrt(squares / double(count));
        const TipError e = estimate.result();
        CHECK(e.samples == c.frames);
        CHECK(e.known());
        CHECK(e.rms > error);
        CHECK(e.rms < 1.6 * error);
    }
}

// 114 Hz under gravity switched on: either run damps away in a few steps what rings on in truth.
TEST_CASE("what a quarter of the step is too coarse for is not known") {
    const Tree tree = rods(true, 2e12);
    for (const auto& [scene, substeps] : {std::pair{let_go(), 1}, std::pair{let_go(), 2}, std::pair{in_wind(), 1}}) {
        const Trajectory truth = ran(tree, scene, {.solver = Solver::articulated_reference}),
                         run = ran(tree, scene, {.solver = Solver::coupled, .steps_per_frame = double(substeps)});
        const Plan<double> plan = planned(tree, scene, Solver::coupled, 1.0 / 30 / substeps);
        State<double> state = make_state(plan);
        const TipError e = estimated(tree, plan, state, 60, substeps);
        CHECK(e.finite);
        CHECK(e.rms < 0.3 * distance(run, truth).rms);
        CHECK_FALSE(e.known());
    }
}

TEST_CASE("what cannot be run is not known") {
    const Tree tree = rods(true, 2e10);
    const Plan<double> plan = planned(tree, shaken(), Solver::coupled, 1.0 / 30);
    State<double> broken = make_state(plan);
    broken.theta_dot[3].x() = NAN; // the companion's start
    ErrorEstimate<double> estimate(tree, plan, broken);
    State<double> whole = make_state(plan);
    for (int k = 0; k < 4; ++k) {
        advance(plan, whole);
        estimate.follow(whole);
    }
    CHECK_FALSE(estimate.result().finite);
    CHECK_FALSE(estimate.result().known());
    CHECK(estimate.result().samples == 0);
}
