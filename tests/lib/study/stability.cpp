// The grid of extremes: every promised cell holds, and the audit that says so can say no.
#include "lib/study/stability.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/model/wood.h"
#include "lib/study/solvers.h"
#include "lib/study/stability_motion.h"
#include "tests/support/make_tree.h"
#include "tests/support/sanitized.h"
#include <catch2/catch.hpp>
#include <map>

using namespace bough;

namespace {

StabilitySetup setup_of(const Tree& tree) {
    StabilitySetup setup;
    setup.tree = tree;
    setup.ranges = {{0, tree.size_bodies(), 0}};
    setup.scene.pose = Pose::rest;
    return setup;
}

const auto no_progress = [](std::int64_t, std::int64_t) {};

} // namespace

TEST_CASE("every promised cell holds, float and double") {
    // The fast path is what runs by default; the plain one gives the same to rounding (tests/lib/coupled/lanes.cpp, tests/lib/analytic/lanes.cpp) and is gone through once.
    const auto on = [](const Tree& tree, std::optional<fast::Target> simd) {
        StabilitySetup setup = setup_of(tree);
        setup.simd = simd;
        return setup;
    };
    const fast::Target simd = fast::best_target().value();
    for (const StabilitySetup& setup :
         {on(make_tree::branched(), std::nullopt), on(make_tree::branched(), simd),
          on(make_tree::chain(20, 4, 0.03, 0.003), simd), on(make_tree::random_tree(60, 3), simd)}) {
        const Tree& tree = setup.tree;
        // What brings trees of its own, and what costs most, once.
        const bool first = setup.simd && tree.size_bodies() == make_tree::branched().size_bodies();
        std::vector<std::string> without;
        if (!first) without = {"depth", "shape", "forest"};
        if (!first || sanitized) without.push_back("10 000 balls");
        without.push_back("chain of 1e5"); // four fifths of the time: `tests/soak grid`
        const StabilityReport report = measure_stability(setup, {40, false, "", without}, no_progress);
        std::map<std::string, std::size_t> promised;
        int compared = 0;
        for (const StabilityCell& cell : report.cells) {
            CAPTURE(tree.name, cell.group, cell.name, cell.solver, cell.precision, cell.note, cell.energy_drift,
                    cell.rms_growth);
            if (!cell.promised) continue;
            ++promised[cell.solver];
            CHECK(cell.finite);
            CHECK(cell.bounded);
            CHECK(cell.moves);
            compared += cell.compared;
        }
        CHECK(compared == 18); // nine cases, in double and float
        CHECK(promised.size() == 2);
        CHECK(promised["coupled"] >= (first ? 90 : 70));
        CHECK(promised["analytic"] == promised["coupled"]);
    }
}

TEST_CASE("the audit sees a method that gains energy") {
    // Euler forward on an undamped pendulum: each step multiplies the energy by 1 + (omega h)^2.
    make_tree::Wood wood;
    wood.damping = 0;
    StabilitySetup setup = setup_of(make_tree::chain(1, 2, 0.03, 0.03, 0, wood));
    setup.scene.gravity = Vec3(3, -9.81, 0);
    const double J = setup.tree.inertia[0](0, 0) + setup.tree.mass[0] * setup.tree.com[0].squaredNorm();
    const double omega = std::sqrt(setup.tree.stiffness[0][0] / J);
    setup.dt = 0.02 / omega;
    const StabilityCell gains =
        run_cell(setup, {"own", "pendulum", true, {}}, Solver::articulated_explicit, false, 1000, [] {});
    CHECK(gains.finite);
    CHECK(gains.energy_drift > 0.1);
    CHECK_FALSE(gains.bounded);
    const StabilityCell keeps = run_cell(setup, {"own", "pendulum", true, {}}, Solver::analytic, false, 1000, [] {});
    CHECK(keeps.energy_drift < 1e-3);
    CHECK(keeps.bounded);
    setup.dt = 10 / omega;
    const StabilityCell bursts =
        run_cell(setup, {"own", "pendulum", true, {}}, Solver::articulated_explicit, false, 1000, [] {});
    CHECK_FALSE(bursts.bounded);
}

TEST_CASE("ringing and angles are counted as they are") {
    // A stiff undamped joint that turns by a known phase a step: sign changes follow.
    make_tree::Wood wood;
    wood.damping = 0;
    StabilitySetup setup = setup_of(make_tree::chain(1, 2, 0.03, 0.03, 0, wood));
    setup.scene.gravity = Vec3(0.3, -9.81, 0); // bends about one axis
    const double J = setup.tree.inertia[0](0, 0) + setup.tree.mass[0] * setup.tree.com[0].squaredNorm();
    const double omega = std::sqrt(setup.tree.stiffness[0][0] / J);
    setup.scene.joint_inertia = JointInertia::paper;
    setup.dt = 2 * 3.14159265358979 / omega / 10.3; // 10.3 steps a period: two sign changes in it, on one of three axes
    const StabilityCell cell = run_cell(setup, {"own", "rod", true, {}}, Solver::analytic, false, 1030, [] {});
    CHECK(cell.ringing == Approx(2 / 10.3 / 3).epsilon(0.02));
    const double sag = 0.3 * setup.tree.mass[0] * setup.tree.com[0].z() / setup.tree.stiffness[0][0];
    CHECK(cell.max_angle == Approx(2 * sag).epsilon(0.05));
    CHECK(cell.guards == 0);
}

TEST_CASE("guards are what the coupled step flags, and none in a motion that the step resolves") {
    // Free about its joint, the rod falls through more than a radian a step.
    StabilitySetup setup = setup_of(make_tree::chain(1, 1, 0.03, 0.03));
    setup.tree.stiffness[0].setZero();
    setup.scene.gravity = Vec3(1, -9.81, 0);
    const auto guards = [&](double dt) {
        setup.dt = dt;
        const StabilityCell cell = run_cell(setup, {"own", "rod", true, {}}, Solver::coupled, false, 40, [] {});
        const auto plan = make_plan<double>(setup.tree, setup.ranges, setup.scene, {}, dt, Solver::coupled);
        State<double> state = make_state(plan);
        for (std::int64_t k = 0; k < cell.frames; ++k) advance(plan, state);
        CHECK(cell.solver == "coupled");
        CHECK(cell.guards == state.flags.half_turns + state.flags.energy_guard + state.flags.fast_turns);
        return cell.guards;
    };
    CHECK(guards(0.2) > 0);
    CHECK(guards(0.005) == 0);
}

TEST_CASE("a cell moves as the truth does within a quarter, and does not stand still in a wind that changes") {
    MotionTruth truth;
    truth.height = 10;
    truth.motion.top = {0.4, 0.2, 1};
    const auto judged = [&](double lean, double spread, std::int64_t still) {
        MotionSummary run;
        run.top = {lean, spread, 1};
        run.still = still;
        StabilityCell cell;
        const std::string wrong = judge_motion(run, truth, cell);
        CHECK(cell.compared);
        CHECK(cell.moves == wrong.empty());
        CHECK(cell.still == still);
        CHECK(cell.lean_error == Approx(lean / 0.4 - 1));
        CHECK(cell.spread_error == Approx(spread / 0.2 - 1));
        return wrong;
    };
    CHECK(judged(0.49, 0.16, 0).empty());
    CHECK(judged(0.51, 0.2, 0) == "trunk's mean lean 0.51 m, truth 0.4");
    CHECK(judged(0.4, 0.14, 0) == "trunk's std 0.14 m, truth 0.2");
    CHECK(judged(0.4, 0.2, 5).empty()); // in a steady wind a tree comes to rest
    truth.unsteady = true;
    CHECK(judged(0.4, 0.2, 5) == "5 still frames");
    CHECK(judged(0.1, 0.1, 5) == "trunk's mean lean 0.1 m, truth 0.4; trunk's std 0.1 m, truth 0.2; 5 still frames");
    truth.motion.still = 1;
    CHECK(judged(0.4, 0.2, 5).empty());
    // What is below a ten-thousandth of the height is none of what a tree does.
    truth.motion.top = {4e-4, 2e-4, 1e-3};
    CHECK(std::abs(4e-4 - 13e-4) < 1e-4 * truth.height);
    MotionSummary run;
    run.top = {13e-4, 11e-4, 1e-3};
    StabilityCell cell;
    CHECK(judge_motion(run, truth, cell).empty());
}

TEST_CASE("trees in leaf move in wind as the truth does") {
    StabilitySetup setup =
        setup_of(segment(grow_bodies(default_growth(), 1, {true, false, false}, 300), wood_presets().front(), {}));
    setup.simd = fast::best_target();
    StabilityOptions grid{60, false, "wind", {"forest", "K x"}};
    for (const StabilityCell& cell : measure_stability(setup, grid, no_progress).cells) {
        CAPTURE(cell.name, cell.precision, cell.note, cell.lean_error, cell.spread_error, cell.still);
        CHECK(cell.moves);
    }
}

TEST_CASE("a tree that is held in a storm does not move as the truth does") {
    StabilitySetup setup = setup_of(make_tree::branched());
    setup.scene.wind = wind_preset("storm");
    const std::optional<MotionTruth> truth = motion_truth(setup, 60, [] {});
    REQUIRE(truth);
    CHECK(truth->unsteady);
    CHECK(truth->motion.still == 0);
    CHECK(truth->motion.top.spread > 1e-4 * truth->height);
    const auto cell = [&](const StabilitySetup& s) {
        return run_cell(
            s, {"own", "storm", true, {}}, Solver::coupled, false, 60, [] {}, &*truth);
    };
    CHECK(cell(setup).moves);
    StabilitySetup held = setup; // its stiffness a hundredfold
    for (Vec3& K : held.tree.stiffness) K *= 100;
    CHECK_FALSE(cell(held).moves);
    CHECK(cell(held).bounded);
}
