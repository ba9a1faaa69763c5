// any_run.h, simulation.h: copies, several steps as one, runs that begin again, trees as they stand, what is shown of walkers.
#include "lib/simulation/any_run.h"
#include "lib/study/solvers.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

namespace {

Scene standing(const char* wind = nullptr) {
    Scene scene;
    scene.add(leafy(), Vec3(1, 0, 2), 30);
    if (wind) scene.wind = wind_preset(wind);
    return scene;
}

Scene breaking() {
    Scene scene = standing("storm");
    scene.fracture = Fracture();
    scene.fracture->leaf = 1e-3;
    return scene;
}

Simulation made(Scene scene, const RunChoice& choice) {
    return make_simulation(std::make_shared<Assembly>(assemble(std::move(scene))), choice);
}

} // namespace

TEST_CASE("a copy goes its own way and ends as the run that it is of, also where bodies break off") {
    std::optional<Simulation> whole(breaking());
    run(*whole, 8);
    Simulation copied = whole->copy(), other = whole->copy();
    other.set_wind(*wind_preset("calm"));
    const std::uint64_t there = run(other, 12), hash = run(*whole, 12);
    CHECK(there != hash);
    whole.reset(); // the trees are kept by whoever is left
    CHECK(copied.steps() == 8);
    CHECK(run(copied, 12) == hash);
    CHECK(copied.positions().size() == copied.tree().size_bodies());
}

TEST_CASE("several steps at once are as many calls, and report all that happened in them") {
    Simulation at_once(breaking()), each(breaking());
    std::vector<std::string> what;
    StepReport sum;
    for (int k = 0; k < 20; ++k) {
        const StepReport report = each.step();
        REQUIRE(report.finite());
        what.insert(what.end(), each.events().what.begin(), each.events().what.end());
        sum.broke += report.broke;
        sum.fast_turns += report.fast_turns;
    }
    const StepReport report = at_once.step(20);
    CHECK(at_once.hash() == each.hash());
    REQUIRE(!what.empty());
    CHECK(at_once.events().what == what);
    CHECK(report.broke == sum.broke);
    CHECK(report.fast_turns == sum.fast_turns);
}

TEST_CASE("a run begins again as it began, whether or not it keeps its trees, with any solver") {
    for (const bool keeps : {true, false})
        for (const Solver solver : {Solver::coupled, Solver::analytic, Solver::articulated_implicit}) {
            RunChoice choice;
            choice.steppers = stepper_maker({.solver = solver, .simd = fast::best_target()});
            choice.keeps_trees = keeps;
            choice.poses = false;
            Simulation simulation = made(standing("gusty"), choice);
            const std::uint64_t hash = run(simulation, 6);
            run_of(simulation).begin_again();
            CHECK(simulation.steps() == 0);
            CHECK(run(simulation, 6) == hash);
            CHECK(simulation.account().solver == solver_name(solver));
            CHECK(run_of(simulation).assembly().tree.mass.empty() == !keeps);
        }
    Simulation simulation(breaking());
    const std::uint64_t hash = run(simulation, 15);
    REQUIRE(!simulation.broken().empty());
    run_of(simulation).begin_again();
    CHECK(simulation.broken().empty());
    CHECK(run(simulation, 15) == hash);
}

TEST_CASE("a saved state is gone on from without the trees") {
    RunChoice choice;
    choice.keeps_trees = false;
    choice.options.precision = Precision::single;
    Simulation whole = made(standing("gusty"), choice), rest = made(standing("gusty"), choice);
    run(whole, 9);
    rest.restore(whole.save());
    CHECK(rest.steps() == 9);
    CHECK(run(rest, 5) == run(whole, 5));
}

TEST_CASE("a tree that is drawn as it stands stays so by itself") {
    Simulation bent(standing("storm"));
    run(bent, 40);
    Scene scene;
    scene.add(bent.posed_tree());
    Simulation still(scene);
    const std::vector<Vec3> there(bent.positions().begin(), bent.positions().end());
    CHECK(apart(still.positions(), there) < 1e-9);
    run(still, 30);
    CHECK(apart(still.positions(), there) < 1e-6);
    Simulation broken(breaking());
    run(broken, 15);
    CHECK_THROWS_WITH(broken.posed_tree(), Catch::Contains("joints broke"));
}

TEST_CASE("a walker is shown where it has walked to") {
    const Tree tree = make_tree::branched();
    Scene scene;
    scene.add(tree);
    Walker walker;
    walker.mass = 1e-3;
    walker.stops.resize(2);
    walker.stops[0].on.body = 0;
    walker.stops[1].on.body = 5; // the end of a branch of 0.8 m
    walker.stops[1].time = 1;
    scene.walkers = {walker};
    Simulation simulation(scene);
    const auto from = [&](std::size_t body) {
        return (simulation.positions()[tree.size_bodies()] - simulation.positions()[body]).norm();
    };
    CHECK(from(0) < 0.4);
    CHECK(from(5) > 0.8);
    run(simulation, 33);
    CHECK(from(0) > 0.8);
    CHECK(from(5) < 0.4);
}

TEST_CASE("a report counts a walker's landing, and not its leap") {
    const Tree tree = make_tree::branched();
    Scene scene;
    scene.add(tree);
    Walker walker;
    walker.mass = 1e-3;
    walker.stops.resize(2);
    walker.stops[0].on.body = 0;
    walker.stops[1].on.body = 5;
    walker.stops[1].time = 1;
    walker.stops[1].leap = true;
    scene.walkers = {walker};
    Simulation simulation(scene);
    std::size_t landed = 0;
    std::vector<std::string> told;
    for (int k = 0; k < 33; ++k) {
        landed += simulation.step().landed;
        for (const std::string& what : simulation.events().what) told.push_back(what);
    }
    CHECK(told == std::vector<std::string>{"leapt", "landed"});
    CHECK(landed == 1);
}
