// simulation.h: runs that are cut, also through a file, and runs that take a motion over.
#include "tests/support/make_tree.h"
#include "tests/support/random_documents.h"
#include "tests/support/simulations.h"
#include <cmath>
#include <functional>

using namespace bough;
using namespace simulations;
using bough::test::Folder;

TEST_CASE("a run that is cut ends as the whole one, also with what broke off and through a file") {
    Scene scene = one(leafy(), "storm");
    scene.fracture = Fracture();
    scene.fracture->leaf = 2e-3;
    Simulation whole(scene), cut(scene);
    const std::uint64_t hash = run(whole, 30);
    run(cut, 14);
    const Folder folder;
    write_state(folder / "state.json", cut.save());
    Simulation again(scene);
    run(again, 3); // it need not be at its start
    again.restore(read_state(folder / "state.json"));
    CHECK(again.steps() == 14);
    CHECK(run(again, 16) == hash);
    CHECK(apart(again.positions(), whole.positions()) == 0);
    Simulation other(one(leafy(), "gusty"));
    CHECK_THROWS_WITH(other.restore(cut.save()), Catch::Contains("/fingerprint"));
    Simulation coarse(scene, {.step = 1.0 / 15});
    CHECK_THROWS_WITH(coarse.restore(cut.save()), Catch::Contains("/fps"));
    SavedState short_one = cut.save();
    short_one.theta_change.pop_back();
    const std::uint64_t there = again.hash();
    CHECK_THROWS_WITH(again.restore(short_one), Catch::Contains("/theta_change"));
    CHECK(again.hash() == there); // what is refused changes nothing
    CHECK(again.steps() == 30);
    SavedState other_scheme = cut.save();
    other_scheme.scheme = "P34";
    CHECK_THROWS_WITH(again.restore(other_scheme), Catch::Contains("/scheme"));
}

TEST_CASE("a state that no file could hold is refused with its place, and changes nothing") {
    Simulation simulation(one(leafy(), "gusty"));
    run(simulation, 3);
    const SavedState saved = simulation.save();
    const std::uint64_t hash = simulation.hash();
    const auto refused = [&](const char* place, const std::function<void(SavedState&)>& change) {
        SavedState changed = saved;
        change(changed);
        CHECK_THROWS_WITH(simulation.restore(changed), Catch::StartsWith(std::string(place) + ":"));
        CHECK(simulation.hash() == hash);
    };
    const double nan = std::nan("");
    refused("/step_change", [](SavedState& s) { s.step_change = {1}; }); // read beyond its end once
    refused("/step_change", [](SavedState& s) { s.step_change = {4, 0.1}; });
    refused("/step_change", [](SavedState& s) { s.step_change = {0.5, 0.1}; });
    refused("/step_change/1", [&](SavedState& s) { s.step_change = {1, nan}; });
    refused("/frame", [](SavedState& s) { s.frame = -1; });
    refused("/frame", [](SavedState& s) { s.frame = std::int64_t(1) << 62; });
    refused("/substeps", [](SavedState& s) { s.substeps = 0; });
    refused("/fps", [&](SavedState& s) { s.fps = nan; });
    refused("/scheme", [](SavedState& s) { s.scheme = "\n"; });
    refused("/solver", [](SavedState& s) { s.solver = std::string(41, 'a'); });
    refused("/part", [](SavedState& s) { s.part = 2; });
    refused("/theta/1", [&](SavedState& s) { s.theta[1].z() = nan; });
    refused("/theta_dot_change/2", [](SavedState& s) { s.theta_dot_change[2].x() = INFINITY; });
    refused("/sleep/0", [&](SavedState& s) { s.sleep = {nan}; });
    refused("/articulated_step", [](SavedState& s) { s.articulated_step = -1; });
}

TEST_CASE("another run takes a motion over where trees agree, whatever their wood") {
    const Tree tree = leafy(), rods = make_tree::branched();
    Scene scene = one(tree, "gusty");
    scene.add(rods, Vec3(20, 0, 0));
    Simulation before(scene);
    run(before, 40);
    Scene stiffer = scene;
    stiffer.stiffness_scale = 2;
    Simulation same(scene, {}, before), after(stiffer, {}, before);
    CHECK(same.steps() == 40);
    CHECK(apart(same.positions(), before.positions()) < 1e-12);
    CHECK(apart(after.positions(), before.positions()) < 1e-12);
    Simulation at_rest(scene);
    const double moved = apart(at_rest.positions(), before.positions());
    run(same, 1), run(before, 1);
    CHECK(apart(same.positions(), before.positions()) < 0.02 * moved); // the last step's change is not known
    // Of two trees the one that is another begins at rest.
    Scene changed;
    changed.add(rods);
    changed.add(rods, Vec3(20, 0, 0));
    changed.wind = scene.wind;
    Simulation mixed(changed, {}, before);
    const std::size_t first = rods.size_bodies(), there = tree.size_bodies();
    CHECK((mixed.positions()[first + 2] - before.positions()[there + 2]).norm() < 1e-9);
    CHECK((mixed.positions()[2] - Simulation(changed).positions()[2]).norm() < 1e-12);
}

TEST_CASE("a pull of a step that is not taken is forgotten where another state is restored") {
    SimulationOptions o;
    o.pulls = true;
    const Tree tree = make_tree::branched();
    Simulation whole(one(tree, "gusty"), o);
    run(whole, 5);
    const SavedState saved = whole.save();
    const std::uint64_t hash = run(whole, 5);
    for (const int before : {0, 3}) {
        Simulation again(one(tree, "gusty"), o);
        run(again, before);
        again.pull(3, Vec3::Zero(), Vec3(5, 0, 0));
        again.restore(saved);
        CHECK(run(again, 5) == hash);
    }
}
