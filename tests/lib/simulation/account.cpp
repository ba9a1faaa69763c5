// What a run says of itself at the door: its account, what broke, its balls, frames in one pass, and steps before time 0 that are the caller's.
#include "lib/simulation/simulation.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"
#include <sstream>

using namespace bough;
using namespace simulations;

namespace {

// Stages that the plan says are on.
std::vector<std::string> stages_on(const Simulation& simulation) {
    std::vector<std::string> on;
    std::istringstream text(simulation.explain());
    for (std::string line; std::getline(text, line);)
        if (line.rfind("stage ", 0) == 0 && line.find(" on: ") != std::string::npos)
            on.push_back(line.substr(6, line.find(" on: ") - 6));
    return on;
}

// A rod with balls high above it, in no air.
Scene thrown_high() {
    Scene scene = one(make_tree::branched());
    scene.air_density = 0;
    scene.balls.resize(2);
    scene.balls[0].position = Vec3(40, 100, 0);
    scene.balls[1].position = Vec3(50, 120, 3);
    scene.balls[1].velocity = Vec3(1, 2, -3);
    scene.balls[1].radius = 0.25;
    return scene;
}

Scene shedding() {
    Scene scene = one(leafy(), "storm");
    scene.fracture = Fracture();
    scene.fracture->leaf = 1e-3;
    return scene;
}

} // namespace

TEST_CASE("an account's stages are those of the plan, each as often as steps were taken") {
    for (const Method method : {Method::coupled, Method::analytic})
        for (const bool portable : {false, true})
            for (const char* wind : {"gusty", (const char*)nullptr}) {
                Simulation simulation(one(leafy(), wind), {.method = method, .portable = portable});
                run(simulation, 7);
                const RunAccount account = simulation.account();
                std::vector<std::string> called;
                for (const StageCalls& of : account.stages) {
                    if (of.calls == 0) continue;
                    CHECK(of.calls == 7);
                    called.push_back(of.stage);
                }
                CHECK(called == stages_on(simulation));
                CHECK(account.bodies == simulation.bodies());
                CHECK(account.solver == (method == Method::coupled ? "coupled" : "analytic"));
                CHECK((account.simd == "none") == portable);
                CHECK(!account.awake.empty());
                CHECK(account.state_bytes == simulation.bytes());
                CHECK(account.free_bytes == 0);
            }
    const RunAccount sleeping = Simulation(one(leafy()), {.sleep = 1e-3}).account();
    CHECK(sleeping.awake.empty());
    CHECK(sleeping.sleep == 1e-3);
}

TEST_CASE("an account's flags are the sum of the reports', also of steps before time 0, which count nothing") {
    Simulation simulation(one(leafy(), "storm"), {});
    simulation.begin_before(5);
    CHECK(simulation.steps() == -5);
    CHECK(simulation.step(2).fast_turns == 0);
    CHECK(simulation.step(4).finite()); // over time 0
    CHECK(simulation.steps() == 1);
    for (const StageCalls& of : simulation.account().stages) CHECK(of.calls <= 1);
    std::uint64_t turns = simulation.account().flags.fast_turns;
    for (int k = 0; k < 60; ++k) turns += simulation.step().fast_turns;
    CHECK(turns > 0);
    CHECK(simulation.account().flags.fast_turns == turns);
}

TEST_CASE("steps before time 0 that the caller takes are those that settle() takes") {
    Simulation at_once(one(leafy(), "gusty"), {}), by_step(one(leafy(), "gusty"), {});
    at_once.settle(2);
    by_step.begin_before(60);
    while (by_step.steps() < 0) REQUIRE(by_step.step().finite());
    CHECK(by_step.time() == 0);
    CHECK(by_step.hash() == at_once.hash());
    CHECK(run(by_step, 10) == run(at_once, 10));
    CHECK_THROWS_WITH(by_step.begin_before(1), Catch::Contains("has begun"));
    for (const std::int64_t steps : {std::int64_t(-1), std::int64_t(1) << 62})
        CHECK_THROWS_WITH(Simulation(one(leafy())).begin_before(steps), Catch::Contains("expected 0 to 1000000000"));
    Simulation before(one(leafy()));
    before.begin_before(2);
    CHECK_THROWS_WITH(before.set_step(1 / 60.0), Catch::Contains("before time 0"));
    before.step(2);
    before.set_step(1 / 60.0);
}

TEST_CASE("what broke is what the events say broke, in their order, and the account counts it") {
    Simulation simulation(shedding());
    CHECK(simulation.broken().empty());
    std::vector<std::uint32_t> broke;
    for (int k = 0; k < 30; ++k) {
        REQUIRE(simulation.step().finite());
        const MotionEvents& events = simulation.events();
        for (std::size_t e = 0; e < events.what.size(); ++e)
            if (events.what[e] == "broke") broke.push_back(std::uint32_t(events.body[e]));
    }
    REQUIRE(!broke.empty());
    CHECK(std::vector<std::uint32_t>(simulation.broken().begin(), simulation.broken().end()) == broke);
    std::array<std::uint64_t, 4> of_kind{};
    for (const std::uint32_t body : broke) ++of_kind[std::size_t(simulation.tree().kind[body])];
    CHECK(simulation.account().broke == of_kind);
    CHECK(simulation.account().free_bytes > 0);
    const Tree shown = simulation.shown_tree(simulation.broken());
    CHECK(shown.size_bodies() == simulation.bodies());
    for (const std::uint32_t body : broke) CHECK(shown.parent[body] == -1);
}

TEST_CASE("balls fall as bodies fall, and are told as they began") {
    const Scene scene = thrown_high();
    Simulation simulation(scene, {.velocities = true});
    const std::size_t trees = simulation.tree().size_bodies();
    run(simulation, 60);
    const std::vector<Ball> balls = simulation.balls();
    REQUIRE(balls.size() == 2);
    CHECK(simulation.bodies() == trees + balls.size());
    const double t = simulation.time();
    for (std::size_t k = 0; k < balls.size(); ++k) {
        CHECK(balls[k].radius == scene.balls[k].radius);
        CHECK(balls[k].position == scene.balls[k].position);
        // Free fall, x + v t + g t^2 / 2, by steps of h that move at the velocity of their ends: g t h / 2 beyond it.
        const double h = simulation.options().step;
        const Vec3 there = balls[k].position + balls[k].velocity * t + 0.5 * t * (t + h) * scene.gravity;
        CHECK((simulation.positions()[trees + k] - there).norm() < 1e-9);
        CHECK((simulation.velocities()[trees + k] - balls[k].velocity - t * scene.gravity).norm() < 1e-9);
    }
    const Tree shown = simulation.shown_tree({});
    REQUIRE(shown.size_bodies() == simulation.bodies());
    CHECK(shown.joint_position[trees + 1] == scene.balls[1].position);
    CHECK(shown.size[trees + 1].y() == 0.25);
}

TEST_CASE("a frame that is filled in is what the spans say") {
    Simulation simulation(shedding(), {.velocities = true, .torques = true, .stresses = true});
    run(simulation, 12);
    MotionFrame frame;
    frame.time = simulation.time();
    CHECK(simulation.fill({true, true, true, true, true}, frame) == "");
    CHECK(apart(frame.position, simulation.positions()) == 0);
    CHECK(apart(frame.velocity, simulation.velocities()) == 0);
    CHECK(apart(frame.angular_velocity, simulation.angular_velocities()) == 0);
    CHECK(apart(frame.torque, simulation.torques()) == 0);
    CHECK(apart(frame.theta, simulation.angles()) == 0);
    CHECK(apart(frame.theta_dot, simulation.rates()) == 0);
    CHECK(std::equal(frame.stress.begin(), frame.stress.end(), simulation.stresses().begin()));
    for (std::size_t i = 0; i < simulation.bodies(); ++i)
        CHECK(frame.rotation[i].coeffs() == simulation.rotations()[i].coeffs());
    CHECK(frame.events.what == simulation.events().what);
    CHECK_THROWS_WITH(simulation.shown_tree(std::vector{std::uint32_t(simulation.bodies())}),
                      Catch::Contains("is not there"));
    const Simulation plain(shedding());
    for (const MotionFields& asked :
         {MotionFields{.velocity = true}, MotionFields{.torque = true}, MotionFields{.stress = true}})
        CHECK_THROWS_WITH(plain.fill(asked, frame), Catch::Contains("fill: asks for"));
    MotionFrame poses;
    CHECK(simulation.fill({}, poses) == "");
    CHECK(poses.velocity.empty());
    CHECK(poses.position.size() == simulation.bodies());
}
