// Simulation::settle: the wind has blown already. Held against runs that began earlier by themselves.
#include "lib/simulation/simulation.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

namespace {

Scene blown(double period) {
    Scene scene = one(leafy(), "gusty");
    scene.wind->period = period;
    return scene;
}

} // namespace

TEST_CASE("what is run before time 0 is the wind of the times before it") {
    // A wind that repeats after 2 s is before time 0 what it is after it: a run of 4 s from rest stands at its end where one settled for 4 s
    // begins, and both go on alike.
    for (const Method method : {Method::coupled, Method::analytic})
        for (const bool portable : {false, true}) {
            SimulationOptions o{.step = 1 / 30., .method = method, .portable = portable};
            Simulation settled(blown(2), o), old(blown(2), o);
            REQUIRE(settled.settle(4).finite());
            CHECK(settled.steps() == 0);
            CHECK(settled.time() == 0);
            run(old, 120);
            CHECK(apart(settled.positions(), old.positions()) < 1e-9);
            run(settled, 30);
            run(old, 30);
            CHECK(apart(settled.positions(), old.positions()) < 1e-7);
            Simulation fresh(blown(2), o);
            run(fresh, 30);
            CHECK(apart(settled.positions(), fresh.positions()) > 0.01); // and it is not the start at rest
        }
}

TEST_CASE("a settled run is cut in two, copied and made on any number of threads as any other") {
    SimulationOptions o{.precision = Precision::single, .threads = 1};
    Simulation whole(one(leafy(), "storm"), o), part(one(leafy(), "storm"), o);
    o.threads = 2;
    Simulation threads(one(leafy(), "storm"), o);
    for (Simulation* s : {&whole, &part, &threads}) REQUIRE(s->settle(s->settling_time()).finite());
    run(part, 7);
    Simulation copied = part.copy(), restored(one(leafy(), "storm"), o); // which is not settled itself
    restored.restore(part.save());
    const std::uint64_t hash = run(whole, 20);
    CHECK(run(threads, 20) == hash);
    CHECK(run(copied, 13) == hash);
    CHECK(run(restored, 13) == hash);
}

TEST_CASE("nothing falls, breaks or is met before time 0") {
    Scene scene = one(leafy(), "storm");
    scene.fracture = Fracture();
    scene.fracture->leaf = 1e-3;
    Ball ball;
    ball.position = Vec3(0, 30, 0);
    scene.balls.push_back(ball);
    Simulation simulation(scene, {});
    const StepReport before = simulation.settle(2);
    CHECK(before.finite());
    CHECK(before.broke + before.hits + before.landed == 0);
    CHECK(simulation.broken().empty());
    CHECK((simulation.positions().back() - ball.position).norm() == 0);
    for (const StageCalls& of : simulation.account().stages) CHECK(of.calls == 0);
    const StepReport first = simulation.step();
    CHECK(first.broke > 0); // what the storm would have taken by then
    CHECK(simulation.positions().back().y() < ball.position.y());
}

TEST_CASE("counts of what was run before are forgotten, a ground stays, a pull of before pulls") {
    Scene scene = one(leafy(), "storm");
    Pull pull;
    pull.on.body = 3;
    pull.time = {-1, -0.2};
    pull.force.assign(2, Vec3(0, 0, 50));
    Simulation plain(scene, {});
    scene.pulls.push_back(pull);
    Simulation pulled(scene, {.grounds = true});
    plain.settle(1);
    pulled.settle(1);
    CHECK(apart(plain.positions(), pulled.positions()) > 1e-3);
    CHECK(pulled.positions()[0] == Vec3(pulled.tree().joint_position[0]));
    for (const StageCalls& of : plain.account().stages) CHECK(of.calls == 0);
    CHECK(plain.steps() == 0);
}

TEST_CASE("only a run at its start settles") {
    Simulation stepped(one(leafy(), "gusty"), {});
    run(stepped, 1);
    CHECK_THROWS_AS(stepped.settle(1), SceneError);
    Simulation twice(one(leafy(), "gusty"), {}), restored(one(leafy(), "gusty"), {});
    twice.settle(0.5);
    CHECK_THROWS_AS(twice.settle(0.5), SceneError);
    restored.restore(stepped.save());
    CHECK_THROWS_AS(restored.settle(1), SceneError);
    Simulation fresh(one(leafy(), "gusty"), {});
    CHECK_THROWS_AS(fresh.settle(-1), SceneError);
    CHECK_THROWS_AS(fresh.settle(std::nan("")), SceneError);
    CHECK_THROWS_AS(fresh.settle(1e12), SceneError); // a lifetime
    const std::uint64_t hash = fresh.hash();
    CHECK(fresh.settle(0).finite());
    CHECK(fresh.hash() == hash);
    CHECK(Simulation(one(leafy()), {}).settling_time() == 0);
}
