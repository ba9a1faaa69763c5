// The door, against plan and state by hand, and against runs begun as it was changed to.
#include "lib/simulation/simulation.h"
#include "lib/lanes/target.h"
#include "lib/laws/wind.h"
#include "lib/plan/state.h"
#include "lib/simulation/any_run.h"
#include "lib/study/solvers.h"
#include "tests/support/count_allocations.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace simulations;

namespace {

SimulationOptions with(Precision precision, Method method = Method::coupled) {
    SimulationOptions o;
    o.precision = precision;
    o.method = method;
    return o;
}

template <class T> std::uint64_t by_hand(const Tree& tree, const Scene& scene, Solver solver, int steps) {
    Plan<T> plan =
        make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, solver, Scheme::p12, fast::best_target());
    State<T> state = make_state(plan);
    for (int k = 0; k < steps; ++k) advance(plan, state);
    return state_hash(plan, state);
}

} // namespace

TEST_CASE("the door's steps are those of plan and state by hand, in both precisions and methods") {
    const Tree tree = leafy();
    const Scene scene = one(tree, "gusty");
    Scene alone;
    alone.wind = scene.wind;
    Simulation a(scene, with(Precision::double_)), b(scene, with(Precision::single)),
        c(scene, with(Precision::double_, Method::analytic)), d(scene, with(Precision::single, Method::analytic));
    CHECK(run(a, 20) == by_hand<double>(tree, alone, Solver::coupled, 20));
    CHECK(run(b, 20) == by_hand<float>(tree, alone, Solver::coupled, 20));
    CHECK(run(c, 20) == by_hand<double>(tree, alone, Solver::analytic, 20));
    CHECK(run(d, 20) == by_hand<float>(tree, alone, Solver::analytic, 20));
    CHECK(a.steps() == 20);
    CHECK(a.time() == Approx(20 / 30.0));
    // What is read, presented or not, and how many threads there are, change nothing.
    SimulationOptions two = with(Precision::double_);
    two.threads = 2;
    two.velocities = two.torques = two.stresses = true;
    Simulation e(scene, two);
    for (int k = 0; k < 20; ++k) {
        e.step();
        CHECK(e.positions().size() == tree.size_bodies());
        CHECK(e.velocities().size() == tree.size_bodies());
        CHECK(e.torques().size() == tree.size_bodies());
        CHECK(e.stresses().size() == tree.size_bodies());
    }
    CHECK(e.hash() == a.hash());
    CHECK(apart(e.positions(), a.positions()) == 0);
    CHECK(a.velocities().empty());
    CHECK(a.stresses().empty());
    CHECK(apart(a.positions(), b.positions()) < 1e-4);
}

TEST_CASE("a simulation keeps what it needs: scene and trees may go") {
    std::optional<Simulation> simulation;
    {
        auto scene = std::make_unique<Scene>(one(leafy(), "gusty"));
        scene->fracture = Fracture();
        scene->fracture->leaf = 1e-3;
        simulation.emplace(*scene);
    }
    std::size_t broke = 0;
    for (int k = 0; k < 30; ++k) {
        const StepReport report = simulation->step();
        REQUIRE(report.finite());
        CHECK(report.broke + report.hits + report.landed == simulation->events().what.size());
        broke += report.broke;
    }
    CHECK(broke > 0);
    Simulation moved = std::move(*simulation);
    simulation.reset();
    CHECK(moved.step().finite());
    CHECK(moved.positions().size() == moved.tree().size_bodies());
}

TEST_CASE("a wind that is changed blows as one that the run began with, and allocates nothing") {
    const Tree tree = leafy();
    Wind other = *wind_preset("storm");
    other.seed = 9;
    const auto everywhere = [](Wind wind) { return wind; };
    const auto in_cells = [](Wind wind) {
        WindGrid& grid = wind.grid.emplace();
        grid.x = grid.z = -4;
        grid.cell = 2;
        grid.columns = grid.rows = 4;
        grid.octaves = {3};
        for (int cell = 1; cell < 16; ++cell) grid.phase.push_back(0.4 * cell);
        return wind;
    };
    const auto turning = [](Wind wind) {
        wind.swirl.emplace().radius = {0, 1, 3};
        wind.swirl->angle = {10, 40, 20};
        return wind;
    };
    using Shape = Wind (*)(Wind);
    const Shape shapes[] = {everywhere, in_cells, turning};
    for (int k = 0; k < 24; ++k) {
        CAPTURE(k);
        const Shape shape = shapes[k / 8];
        SimulationOptions o =
            with(k / 4 % 2 ? Precision::single : Precision::double_, k / 2 % 2 ? Method::coupled : Method::analytic);
        o.portable = k % 2;
        Scene there = one(tree), here = one(tree);
        const Wind gusty = shape(*wind_preset("gusty")), storm = shape(other);
        there.wind = gusty;
        here.wind = storm;
        Simulation changed(there, o), begun(here, o), left(there, o);
        changed.set_wind(storm);
        const std::uint64_t hash = run(begun, 15);
        CHECK(run(changed, 15) == hash);
        CHECK(run(left, 15) != hash);
        Wind wider = gusty;
        (wider.swirl ? wider.swirl->period : wider.grid ? wider.grid->frequency : wider.profile) *= 2;
        CHECK_THROWS_WITH(changed.set_wind(wider), Catch::Contains("all else of it stays as the run began"));
        CHECK(run_of(changed).scene().wind == storm); // as it was, the numbers ahead too: it was set at time 0
        const std::size_t before = allocations;
        changed.set_wind(gusty);
        changed.step();
        const std::size_t after = allocations; // before CHECK, which allocates itself
        CHECK(after == before);
    }
    Scene behind = one(tree, "gusty"); // its shelter stays that of the start
    behind.wind->shelter = WindShelter{2};
    Simulation sheltered(behind);
    run(sheltered, 3);
    behind.wind->velocity = Vec3(2, 0, 3);
    const std::size_t before = allocations;
    sheltered.set_wind(*behind.wind);
    const std::size_t after = allocations;
    CHECK(after == before);
    Simulation still(one(tree));
    CHECK_THROWS_WITH(still.set_wind(other), Catch::Contains("began without one"));
    Simulation windy(one(tree, "gusty"));
    other.velocity.x() = NAN;
    CHECK_THROWS_AS(windy.set_wind(other), SceneError);
    CHECK(windy.step().finite());
}

TEST_CASE("a wind that changes at any time does not jump, and its turbulence's phase is the speed's integral") {
    const Tree tree = make_tree::branched();
    Simulation simulation(one(tree, "gusty"));
    const auto wind = [&] { return *run_of(simulation).scene().wind; };
    Wind asked = *wind_preset("gusty");
    double way = 0; // [m] what the phases go by
    for (int k = 0; k < 1200; ++k) {
        REQUIRE(simulation.step().finite());
        way += asked.velocity.norm() / 30;
        const Wind before = wind();
        const double t = simulation.time();
        asked.velocity = (8 + 3 * std::sin(0.01 * k)) * Vec3(std::cos(1e-3 * k), 0, std::sin(1e-3 * k));
        asked.gust_period = 6 + std::sin(0.003 * k);
        simulation.set_wind(asked);
        CHECK((wind_velocity(wind(), t) - wind_velocity(before, t)).norm() <
              0.15); // 0.03 m/s more, and a thousandth of a turn
    }
    const double speed = asked.velocity.norm();
    Wind same = asked; // at the speed of now all along, but for the gusts
    same.gust_factor = asked.gust_factor = 1;
    asked.turbulence_ahead = wind().turbulence_ahead;
    CHECK((wind_velocity(asked, simulation.time()) - wind_velocity(same, way / speed)).norm() < 1e-6);
    CHECK(wind_velocity(same, 1).norm() > 1);
    Wind none = asked;
    none.velocity.setZero();
    simulation.set_wind(none);
    simulation.set_wind(asked);
    REQUIRE(simulation.step(30).finite());
}

TEST_CASE("gravity that is changed pulls as one that the run began with, and allocates nothing") {
    const Tree tree = make_tree::branched();
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const bool portable : {false, true}) {
            SimulationOptions o = with(precision);
            o.portable = portable;
            Scene full = one(tree), tilted = one(tree);
            full.pose = tilted.pose = Pose::rest; // where the springs' rest does not hang on gravity
            tilted.gravity = Vec3(1, -3, 0);
            Simulation changed(full, o), begun(tilted, o);
            changed.set_gravity(tilted.gravity);
            CHECK(run(changed, 30) == run(begun, 30));
            const std::size_t before = allocations;
            changed.set_gravity(Vec3(-1, -9, 0));
            changed.step();
            const std::size_t after = allocations; // before CHECK, which allocates itself
            CHECK(after == before);
        }
    Scene none = one(tree);
    none.gravity.setZero();
    Simulation floating(none);
    CHECK_THROWS_AS(floating.set_gravity(Vec3(0, -1, 0)), SceneError);
    Simulation paper(one(tree), with(Precision::double_, Method::analytic));
    CHECK_THROWS_AS(paper.set_gravity(Vec3(0, -1, 0)), SceneError);
    Simulation good(one(tree));
    CHECK_THROWS_AS(good.set_gravity(Vec3(0, NAN, 0)), SceneError);
}

TEST_CASE("wood that is changed moves as wood that the run began with, and allocates nothing") {
    const Tree tree = leafy();
    for (const bool portable : {false, true})
        for (const Precision precision : {Precision::single, Precision::double_}) {
            SimulationOptions o = with(precision);
            o.portable = portable;
            Scene own = one(tree, "gusty");
            own.pose = Pose::rest; // where the springs' rest does not hang on them
            Scene other = own;
            other.stiffness_scale = 1.7;
            other.damping_scale = 0.4;
            Simulation changed(own, o), begun(other, o), left(own, o);
            const std::size_t before = allocations;
            changed.set_wood(3, 1);
            changed.set_wood(1.7, 0.4);
            const std::size_t after = allocations;
            CHECK(after == before);
            run(changed, 15), run(begun, 15), run(left, 15);
            const double moved = apart(left.positions(), begun.positions());
            REQUIRE(moved > 1e-3);
            CHECK(apart(changed.positions(), begun.positions()) <
                  (precision == Precision::single ? 1e-3 : 1e-10) * moved);
            const SavedState saved = changed.save(); // goes on with the wood that is set
            run(changed, 5);
            left.set_wood(1.7, 0.4);
            left.restore(saved);
            CHECK(left.steps() == 15);
            run(left, 5);
            CHECK(apart(left.positions(), changed.positions()) < 1e-3 * moved);
            const std::size_t then = allocations;
            changed.set_wood(3, 1);
            changed.step();
            const std::size_t stepped = allocations;
            CHECK(stepped == then);
        }
    Simulation good(one(tree));
    for (const double bad : {0.0, -1.0, double(NAN), double(INFINITY)})
        CHECK_THROWS_AS(good.set_wood(bad, 1), SceneError);
    for (const double bad : {-1.0, double(NAN), double(INFINITY)}) CHECK_THROWS_AS(good.set_wood(1, bad), SceneError);
    good.set_wood(1, 0);
    CHECK_THROWS_WITH(good.set_wood(1, 1), Catch::Contains("back"));
    Simulation paper(one(tree), with(Precision::double_, Method::analytic));
    CHECK_THROWS_AS(paper.set_wood(2, 1), SceneError);
}

TEST_CASE("a run with attachments that is cut ends as the whole one, bit by bit") {
    const Tree tree = make_tree::branched();
    Scene held = one(tree, "gusty");
    held.attachments.resize(2);
    held.attachments[0].on.body = 9;
    held.attachments[0].stiffness = 500;
    held.attachments[0].target = Vec3(0.2, 1.2, 0.1);
    held.attachments[1].on.body = 12;
    held.attachments[1].damping = 2;
    held.attachments[1].time = {0, 0.4, 1};
    held.attachments[1].position = {Vec3(0, 1, 0), Vec3(0.3, 1, 0), Vec3(0, 1, 0.2)};
    held.attachments[1].to = 0.9;
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const auto& [method, portable] : {std::pair(Method::coupled, false), std::pair(Method::coupled, true),
                                               std::pair(Method::analytic, false)}) {
            SimulationOptions o = with(precision, method);
            o.portable = portable;
            Simulation whole(held, o), second(held, o);
            run(whole, 17);
            const SavedState saved = whole.save();
            CHECK(saved.attachments.size() == 12);
            run(whole, 20);
            second.restore(saved);
            CHECK(run(second, 20) == whole.hash());
            SavedState broken = saved;
            broken.attachments.pop_back();
            CHECK_THROWS_AS(second.restore(broken), SceneError);
        }
}

TEST_CASE("trees that sleep wake with what is changed, and with pulls do not sleep") {
    const Tree tree = make_tree::branched();
    SimulationOptions o;
    o.sleep = 1e-3;
    Scene scene = one(tree);
    scene.wind.emplace(); // still air
    const auto asleep = [&] {
        auto simulation = std::make_unique<Simulation>(scene, o);
        run(*simulation, 60);
        const std::uint64_t hash = simulation->hash();
        REQUIRE(run(*simulation, 5) == hash);
        return simulation;
    };
    const auto moved = [](Simulation& simulation) {
        const std::vector<Vec3> before(simulation.positions().begin(), simulation.positions().end());
        run(simulation, 20);
        return apart(before, simulation.positions());
    };
    Wind breeze;
    breeze.velocity = Vec3(8, 0, 0);
    const auto windy = asleep(), heavy = asleep(), soft = asleep();
    windy->set_wind(breeze);
    CHECK(moved(*windy) > 1e-4);
    heavy->set_gravity(Vec3(3, -9.81, 0));
    CHECK(moved(*heavy) > 1e-4);
    soft->set_wood(0.3, 1);
    CHECK(moved(*soft) > 1e-6);
    CHECK_THROWS_WITH(windy->set_wind(*wind_preset("gusty")), Catch::Contains("sleep"));
    o.pulls = true;
    Simulation pulled(scene, o);
    run(pulled, 60);
    pulled.pull(tree.size_bodies() - 1, Vec3::Zero(), Vec3(2, 0, 0));
    CHECK(moved(pulled) > 1e-7);
    CHECK(pulled.explain().find("forces of the caller") != std::string::npos);
}

TEST_CASE("what became non-finite is said once more, and is not gone on with") {
    Tree tree = make_tree::branched();
    SimulationOptions o = with(Precision::single);
    o.pulls = true;
    Simulation simulation(one(tree), o);
    simulation.pull(3, Vec3::Zero(), Vec3(1e38, 1e38, 0));
    simulation.pull(3, Vec3(0, 0, 0.1), Vec3(-1e38, 3e38, 1e38));
    StepReport report = simulation.step();
    for (int k = 0; k < 3 && report.finite(); ++k) report = simulation.step();
    REQUIRE_FALSE(report.finite());
    CHECK(report.non_finite.find("stage ") == 0);
    CHECK(report.non_finite.find("body ") != std::string::npos);
    const std::int64_t steps = simulation.steps();
    CHECK(simulation.step().non_finite == report.non_finite);
    CHECK(simulation.steps() == steps);
}

TEST_CASE("joints that are held are shown with all bodies, and the plan says why") {
    Scene scene = one(leafy(), "gusty");
    scene.simulate = Simulate();
    scene.simulate->last_level = 1;
    Simulation simulation(scene);
    run(simulation, 5);
    CHECK(simulation.bodies() == leafy().size_bodies());
    CHECK(simulation.positions().size() == simulation.bodies());
    CHECK(simulation.explain().find("/simulate") != std::string::npos);
    CHECK(simulation.explain().find("stage ") != std::string::npos);
    CHECK(simulation.bytes() > 0);
}
