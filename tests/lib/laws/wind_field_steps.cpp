// A wind that varies over the ground, in the steps: a tree in a cell moves as it does alone in that cell's wind; lanes against the plain step,
// which is other code; the coupled step's order, which it has only if the wind's change over the step is right.
#include "tests/support/coupled_support.h"
#include "tests/support/lanes_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace lanes;

namespace {

constexpr Solver lane_solvers[] = {Solver::coupled, Solver::analytic};

// Rows of cells of 7 m about the trees, no two alike; a swirl; gusts, turbulence and a profile.
Wind field() {
    Wind wind = gusts();
    WindGrid grid;
    grid.x = -9.37;
    grid.z = -11.21;
    grid.cell = 2.3;
    grid.columns = 9;
    grid.rows = 8;
    for (int k = 0; k < 72; ++k) {
        grid.velocity.push_back(Vec3(6 + 0.02 * k, 0.3 - 0.01 * k, 2 - 0.03 * k));
        grid.phase.push_back(0.1 * k);
    }
    grid.octaves = {3};
    wind.grid = grid;
    wind.swirl.emplace();
    wind.swirl->x = 0.3;
    wind.swirl->radius = {0, 3};
    wind.swirl->angle = {10, 40};
    wind.swirl->wavelength = 4;
    return wind;
}

Wind sheltered_field() {
    Wind wind = field();
    wind.shelter = WindShelter{1.5};
    return wind;
}

Wind grid_alone() {
    Wind wind = field();
    wind.swirl.reset();
    return wind;
}

Wind swirl_alone() {
    Wind wind = field();
    wind.grid.reset();
    return wind;
}

std::vector<Case> cases(Solver solver) {
    const Tree large = firm(grown(600)), leafy = coupled::leafy(1e9, 0.01);
    std::vector<Case> all;
    all.push_back({"grid, swirl", large, in_wind(field())});
    all.push_back({"grid", leafy, in_wind(grid_alone())});
    all.push_back({"swirl", leafy, in_wind(swirl_alone())});
    all.push_back({"with shelter", large, in_wind(sheltered_field())});
    Scene bare = solver::empty_scene();
    bare.wind = field();
    all.push_back({"no gravity", large, bare});
    Case forest{"three trees and pulls", {}, in_wind(field())};
    forest.tree = three_trees(forest.ranges);
    forest.scene.pulls = pulls();
    if (solver == Solver::coupled) forest.scene.root_motion = {shifted(1)};
    all.push_back(forest);
    if (solver == Solver::coupled) {
        Scene moved = in_wind(field());
        moved.root_motion = {carried_about()};
        all.push_back({"ground that moves and turns", leafy, moved});
    }
    all.push_back({"several blocks", firm(grown(3000)), in_wind(field())});
    for (Case& c : all) c.solver = solver;
    return all;
}

// One beside the other, `apart` m along x.
Tree pair_of(const Tree& tree, double apart) {
    Tree other = tree;
    for (std::size_t i = 0; i < other.size_bodies(); ++i)
        if (other.parent[i] < 0) other.joint_position[i].x() += apart;
    return make_tree::forest({tree, other});
}

} // namespace

TEST_CASE("a tree in a cell moves as alone in that cell's wind") {
    const Tree tree = coupled::leafy(1e9, 0.01);
    const std::size_t n = tree.size_bodies();
    Wind alone = gusts();
    alone.turbulence = 0; // which is of the mean's magnitude
    Wind both = alone;
    both.grid.emplace();
    both.grid->x = -40;
    both.grid->z = 100; // beside them: the nearest row
    both.grid->cell = 50;
    both.grid->columns = 3;
    both.grid->rows = 1;
    both.grid->velocity = {Vec3(9, 0.2, 1), Vec3(-3, 0, 6), Vec3(50, 0, 0)};
    for (const Solver solver : all_solvers)
        for (const Simd simd : {Simd(), Simd(fast::best_target())}) {
            if (simd && is_articulated(solver)) continue;
            // Leaves in wind are too stiff for the explicit one at this step; the reference cuts it by the worse of the two trees.
            if (solver == Solver::articulated_explicit || solver == Solver::articulated_reference) continue;
            Case forest{"", pair_of(tree, 50), in_wind(both)};
            forest.ranges = {{0, n, 0}, {n, n, *std::max_element(tree.branch.begin(), tree.branch.end()) + 1}};
            forest.solver = solver;
            LanesRun<> pair(forest, simd);
            REQUIRE(pair.plan.stepper->in_lanes() == simd.has_value());
            for (int k = 0; k < 40; ++k) pair.frame();
            for (std::size_t which : {std::size_t(0), std::size_t(1)}) {
                Case single{"", tree, in_wind(alone)};
                single.scene.wind->velocity = both.grid->velocity[which];
                single.solver = solver;
                LanesRun<> one(single, simd);
                for (int k = 0; k < 40; ++k) one.frame();
                CAPTURE(solver_name(solver), simd.has_value(), which);
                double off = 0, bent = 0;
                for (std::size_t i = 0; i < n; ++i) {
                    off = std::max(off, (pair.state.theta[which * n + i] - one.state.theta[i]).norm());
                    bent = std::max(bent, (one.state.theta[i] - one.plan.theta_start[i]).norm());
                }
                REQUIRE(bent > 0.01);
                CHECK(off < 1e-9);
            }
        }
}

TEST_CASE("one cell without octaves gives the uniform wind's motion") {
    const Tree tree = firm(grown(600));
    Wind one = gusts();
    one.grid.emplace();
    one.grid->cell = 1;
    one.grid->columns = one.grid->rows = 1;
    for (const Solver solver : lane_solvers)
        for (const Simd simd : {Simd(), Simd(fast::best_target())}) {
            Case uniform{"", tree, in_wind(gusts())}, cell{"", tree, in_wind(one)};
            uniform.solver = cell.solver = solver;
            LanesRun<> a(uniform, simd), b(cell, simd);
            const Apart d = run_apart(a, b, 60);
            CAPTURE(solver_name(solver), simd.has_value());
            CHECK(d.theta < 1e-11);
            CHECK(d.x < 1e-11);
        }
}

TEST_CASE("in double, lanes and the plain step are the same to rounding in a wind that varies over the ground") {
    for (const Solver solver : lane_solvers)
        for (const Case& c : cases(solver)) {
            LanesRun<> plain(c, std::nullopt), lanes(c, fast::best_target());
            CAPTURE(c.name, solver_name(solver));
            REQUIRE(lanes.plan.stepper->in_lanes());
            REQUIRE(lanes.plan.field);
            const std::vector<Vec3> start = plain.state.theta;
            const Apart d = run_apart(plain, lanes, 60);
            REQUIRE(most(start, plain.state.theta) > 1e-3);
            CHECK(d.theta < 1e-11);
            CHECK(d.theta_dot < 1e-9);
            CHECK(d.x < 1e-11);
            CHECK(lanes.state.flags.energy_guard == plain.state.flags.energy_guard);
            CHECK(lanes.calls(Stage::lanes) == 60);
            CHECK(plain.calls(Stage::wind_field) == 60);
        }
}

TEST_CASE("two solves a step, and every target, come to the same in it") {
    for (const Case& c : cases(Solver::coupled)) {
        if (c.tree.size_bodies() > 1000) continue;
        LanesRun<> plain(c, std::nullopt, Scheme::p34), lanes(c, fast::best_target(), Scheme::p34);
        const Apart d = run_apart(plain, lanes, 30);
        CAPTURE(c.name);
        CHECK(d.theta < 1e-9);
        CHECK(d.x < 1e-10);
    }
    for (const Solver solver : lane_solvers)
        for (const Case& c : cases(solver)) {
            if (c.tree.size_bodies() > 1000) continue;
            check_targets_agree(c, 1e-3); // in float some body may stand on the other side of a cell's edge for a step
            if (solver == Solver::coupled && both_wide()) check_same_bits(c);
        }
}

TEST_CASE("the energy guard weighs the air of the place") {
    for (const Wind& wind : {field(), sheltered_field()}) {
        Case c{"", grown(600), solver::empty_scene(), 0.05, 3};
        c.scene.wind = wind;
        LanesRun<> plain(c, std::nullopt), lanes(c, fast::best_target());
        const Apart d = run_apart(plain, lanes, 5);
        REQUIRE(plain.state.flags.energy_guard > 0);
        CHECK(lanes.state.flags.energy_guard == plain.state.flags.energy_guard);
        CHECK(d.theta < 1e-9);
        CHECK(d.theta_dot < 1e-7);
    }
}

TEST_CASE("in float, lanes stay as near to double in a swirl as the plain step") {
    for (const Solver solver : lane_solvers) {
        Case c{"swirl", firm(grown(600)), in_wind(swirl_alone())};
        c.solver = solver;
        check_float_drift(c, 200);
    }
}

TEST_CASE("the coupled step is of order 2 in swells and swirl, and goes to the reference") {
    using coupled::Motion;
    Scene scene = solver::empty_scene();
    scene.wind = Wind();
    scene.wind->velocity = Vec3(8, 0, 2.4);
    scene.wind->profile = 0; // its table over height has corners
    scene.wind->grid.emplace();
    scene.wind->grid->cell = 1;
    scene.wind->grid->columns = scene.wind->grid->rows = 1;
    scene.wind->grid->octaves = {2};
    scene.wind->grid->frequency = 0.8;
    scene.wind->swirl.emplace();
    scene.wind->swirl->angle = {50};
    scene.wind->swirl->period = 1.3;
    const Motion chain{paper_trees::chain(2e9, 0.01), scene, 20}, branched{paper_trees::branched(2e8, 0.01), scene, 20};
    for (const Motion& motion : {chain, branched}) {
        const coupled::Track truth = coupled::truth_of(motion);
        CAPTURE(motion.tree.name);
        CHECK(coupled::error_of(motion, truth, Scheme::p34, 1024) < 1e-6);
    }
    // (The L-stable schemes follow a strong load on the chain's thin end with a lag: tests/lib/coupled/order.cpp.)
    const coupled::Track truth = coupled::truth_of(branched);
    for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
        CAPTURE(scheme_of(scheme).name);
        // Near 2: the air's stiffness begins with a kink where drag begins to pull outward (air.h).
        CHECK(coupled::order_at(branched, truth, scheme, 2) >= 1.75);
    }
}

TEST_CASE("what sleeps in a steady field is woken by none that swells") {
    Case c{"", firm(grown(600)), in_wind(grid_alone())};
    c.scene.wind->turbulence = 0;
    c.scene.wind->gust_factor = 1;
    const auto reason = [&] {
        return parts::lanes(LanesRun<>(c, fast::best_target(), Scheme::p12, {}, std::nullopt, 0.01).plan).sleep.reason;
    };
    CHECK(reason() == "/wind/grid");
    c.scene.wind->grid->octaves = {0};
    CHECK(reason() == "");
    c.scene.wind->swirl = swirl_alone().swirl;
    CHECK(reason() == "/wind/swirl");
}
