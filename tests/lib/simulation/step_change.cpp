// Simulation::set_step: against runs that began so, and against a run of far finer steps.
#include "tests/support/make_tree.h"
#include "tests/support/paper_trees.h"
#include "tests/support/random_documents.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

namespace {

SimulationOptions in_steps(double step, Precision precision = Precision::double_, bool portable = false) {
    return {.step = step, .precision = precision, .portable = portable};
}

// RMS distance of two runs' joints [m].
double off(const Simulation& a, const Simulation& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.bodies(); ++i) sum += (a.positions()[i] - b.positions()[i]).squaredNorm();
    return std::sqrt(sum / double(a.bodies()));
}

// A chain of soft rods let go: it swings far, where each step stands on what the last one changed.
Scene falling() {
    Scene scene = one(paper_trees::chain(2e8, 0.02));
    scene.pose = Pose::rest;
    return scene;
}

// A second of steps of h, 2 h, 3 h and again, n h a second; n a multiple of 6.
Simulation run_unevenly(int n, bool portable) {
    const double h = 1.0 / n;
    Simulation run(falling(), in_steps(h, Precision::double_, portable));
    for (int k = 0; k < n / 2; ++k) {
        run.set_step((1 + k % 3) * h);
        run.step();
    }
    return run;
}

} // namespace

TEST_CASE("steps of another length from the start on are those of a run begun so, and the time is theirs") {
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const bool portable : {false, true}) {
            Simulation begun(one(leafy(), "gusty"), in_steps(1 / 48.0, precision, portable)),
                changed(one(leafy(), "gusty"), in_steps(1 / 30.0, precision, portable)),
                left(one(leafy(), "gusty"), in_steps(1 / 30.0, precision, portable));
            changed.set_step(1 / 48.0);
            CHECK(run(changed, 20) == run(begun, 20));
            CHECK(run(left, 20) != begun.hash());
            CHECK(changed.time() == begun.time());
            CHECK(changed.options().step == 1 / 48.0);
            // On the way the time goes on.
            changed.set_step(0.01);
            changed.step(3);
            CHECK(changed.time() == Approx(20 / 48.0 + 0.03).epsilon(1e-14));
            CHECK(changed.steps() == 23);
        }
}

TEST_CASE("a motion in steps of changing length is of second order, as one in even ones") {
    for (const bool portable : {false, true}) {
        Simulation truth(falling(), in_steps(1 / 7680.0));
        run(truth, 7680);
        const double coarse = off(run_unevenly(240, portable), truth), fine = off(run_unevenly(480, portable), truth),
                     finer = off(run_unevenly(960, portable), truth);
        INFO("errors " << coarse << ", " << fine << ", " << finer << " m");
        CHECK(coarse < 2e-3);
        CHECK(coarse > 2.8 * fine); // 4 and beyond, where it is of second order
        CHECK(fine > 2.8 * finer);
        CHECK(run_unevenly(480, portable).time() == Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("a run whose step changed is cut in two, copied and taken over as any other") {
    for (const Precision precision : {Precision::single, Precision::double_}) {
        Simulation whole(one(leafy(), "gusty"), in_steps(1 / 30.0, precision));
        run(whole, 7);
        whole.set_step(0.011);
        run(whole, 4);
        Simulation copied = whole.copy();
        const test::Folder folder;
        write_state(folder / "state.json", whole.save());
        const SavedState saved = read_state(folder / "state.json");
        const std::uint64_t end = run(whole, 6);
        CHECK(run(copied, 6) == end);
        CHECK(copied.time() == whole.time());
        Simulation second(one(leafy(), "gusty"), in_steps(0.011, precision));
        second.restore(saved);
        CHECK(run(second, 6) == end);
        CHECK(second.time() == whole.time());
        second.restore(saved); // and once more, from where it is by now
        CHECK(run(second, 6) == end);
        Simulation other(one(leafy(), "gusty"), in_steps(1 / 30.0, precision));
        CHECK_THROWS_WITH(other.restore(saved), Catch::Contains("/fps"));
    }
}

TEST_CASE("a step that is halved and doubled again is as if nothing had been") {
    Scene swinging = one(leafy());
    swinging.pose = Pose::rest; // and no wind: nothing asks for the time, whose last digit another sum makes
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const bool portable : {false, true}) {
            Simulation changed(swinging, in_steps(1 / 30.0, precision, portable)),
                begun(swinging, in_steps(1 / 30.0, precision, portable));
            for (int k = 0; k < 10; ++k) {
                changed.set_step(1 / 60.0);
                changed.set_step(1 / 30.0);
                CHECK(run(changed, 1) == run(begun, 1));
            }
            changed.set_step(1 / 60.0);
            CHECK(run(changed, 1) != run(begun, 1));
        }
}

TEST_CASE("trees that sleep wake where the step changes, and fall asleep again by the clock") {
    SimulationOptions o = in_steps(1 / 30.0);
    o.sleep = 1e-3;
    Simulation simulation(one(make_tree::branched()), o);
    run(simulation, 60);
    const std::uint64_t asleep = simulation.hash();
    REQUIRE(run(simulation, 5) == asleep);
    simulation.set_gravity(Vec3(0.1, -9.81, 0));
    simulation.set_step(1 / 120.0);
    CHECK(run(simulation, 1) != asleep);
    double awake = 0; // [s]
    for (std::uint64_t last = 0; awake < 20 && simulation.hash() != last; awake += 1 / 120.0) {
        last = simulation.hash();
        run(simulation, 1);
    }
    CHECK(awake > 1); // a second of rest, not as many steps as before
    CHECK(awake < 20);
}

TEST_CASE("a step that is none is refused") {
    Simulation simulation(one(leafy()));
    for (const double step : {0.0, -1.0, double(NAN), double(INFINITY)})
        CHECK_THROWS_WITH(simulation.set_step(step), Catch::Contains("set_step: is"));
    Simulation analytic(one(leafy()), {.method = Method::analytic});
    CHECK_THROWS_WITH(analytic.set_step(0.01), Catch::Contains("coupled method"));
    CHECK(simulation.step().finite());
}
