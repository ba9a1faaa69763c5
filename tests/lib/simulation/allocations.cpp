// What a run allocates once it has taken a few steps, whatever is done to it between them: nothing. (Changes of wind, gravity and wood: simulation.cpp.
// With a sanitizer nothing is counted.)
#include "lib/lanes/row.h"
#include "lib/simulation/simulation.h"
#include "tests/support/count_allocations.h"
#include "tests/support/make_tree.h"
#include "tests/support/sanitized.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

namespace {

// How many a frame takes after three like it. It may hold no assertion, which allocates itself.
template <class Frame> std::size_t allocated(Frame&& frame) {
    for (int k = 0; k < 3; ++k) frame();
    const std::size_t before = allocations;
    frame();
    return allocations - before;
}

// All methods, paths and precisions.
std::vector<SimulationOptions> all_options() {
    std::vector<SimulationOptions> all;
    for (const Method method : {Method::coupled, Method::analytic})
        for (const Precision precision : {Precision::single, Precision::double_})
            for (const bool portable : {false, true}) {
                all.emplace_back().method = method;
                all.back().precision = precision;
                all.back().portable = portable;
            }
    return all;
}

#define CAPTURE_OPTIONS(o) CAPTURE(int(o.method), int(o.precision), o.portable)

} // namespace

TEST_CASE("what is allocated is counted") {
    if (sanitized) return;
    std::unique_ptr<double> kept;
    CHECK(allocated([&] { kept = std::make_unique<double>(1); }) == 1);
    const std::size_t before = allocations;
    fast::free_rows(fast::allocate_rows(64));
    CHECK(allocations - before == 1);
}

TEST_CASE("a step with trees that are tied to each other allocates nothing") {
    for (SimulationOptions o : all_options()) {
        CAPTURE_OPTIONS(o);
        Scene scene = one(make_tree::branched(), "gusty");
        scene.add(make_tree::branched(), Vec3(2, 0, 0));
        scene.attachments.resize(8);
        for (std::size_t k = 0; k < 8; ++k) {
            Attachment& held = scene.attachments[k];
            held.on.body = std::int64_t(k);
            held.with = Selector();
            held.with->tree = 1;
            held.with->body = std::int64_t(k);
            held.stiffness = 100;
        }
        o.threads = 1;
        Simulation tied(scene, o);
        CHECK(allocated([&] { tied.step(); }) == 0);
        CHECK(tied.step().finite());
    }
}

TEST_CASE("a step of a large tree, pulled and looked at, allocates nothing on one thread or several") {
    if (sanitized) return; // which nothing but time would come of
    const Tree tree = convert(grow("broadleaf", {.bodies = 6000, .seed = 5, .leaves = true, .fruit = true}));
    for (const Precision precision : {Precision::single, Precision::double_}) {
        SimulationOptions o;
        o.precision = precision;
        o.threads = precision == Precision::single ? 3 : 1;
        o.pulls = o.velocities = true;
        Simulation simulation(one(tree, "gusty"), o);
        std::size_t shown = 0;
        CHECK(allocated([&] {
                  simulation.pull(5, Vec3::Zero(), Vec3(0.01, 0, 0));
                  simulation.step();
                  shown = simulation.positions().size() + simulation.velocities().size();
              }) == 0);
        CHECK(simulation.step().finite());
        CHECK(shown == 2 * tree.size_bodies());
    }
}

TEST_CASE("pulls and the steps that take them allocate nothing, no more points being pulled than before") {
    const Tree tree = make_tree::branched();
    const std::size_t body = tree.size_bodies() - 1;
    for (SimulationOptions o : all_options()) {
        CAPTURE_OPTIONS(o);
        o.pulls = true;
        Simulation simulation(one(tree, "gusty"), o);
        const auto frame = [&] {
            for (const std::size_t pulls : {2, 0, 1}) {
                for (std::size_t k = 0; k < pulls; ++k)
                    simulation.pull(body - k, Vec3(0, 0, tree.size[body - k][0]), Vec3(0.3, 0.1, -0.2));
                simulation.step();
            }
        };
        CHECK(allocated(frame) == 0);
        CHECK(simulation.step().finite());
    }
}

TEST_CASE("moving a hand allocates nothing, nor does a step with it") {
    const Tree tree = make_tree::branched();
    const std::size_t body = tree.size_bodies() - 1;
    for (const SimulationOptions& o : all_options()) {
        if (o.method == Method::analytic) continue; // it has none
        CAPTURE_OPTIONS(o);
        Simulation simulation(one(tree, "breeze"), o);
        const std::uint64_t hand = simulation.attach(body, Vec3(0, 0, tree.size[body][0]), 40, 0.5);
        Vec3 to = simulation.positions()[body];
        const auto frame = [&] {
            to.x() += 0.01;
            simulation.move_attachment(hand, to, 3); // on its way, and then there at once
            simulation.step();
            simulation.move_attachment(hand, to, 0);
            simulation.step();
        };
        CHECK(allocated(frame) == 0);
        CHECK(simulation.attachment_force(hand).norm() > 0);
    }
}

TEST_CASE("leading a ground allocates nothing, nor does a step on it") {
    for (SimulationOptions o : all_options()) {
        CAPTURE_OPTIONS(o);
        o.grounds = true;
        Simulation simulation(one(make_tree::branched(), "gusty"), o);
        GroundMotion motion;
        motion.velocity = Vec3(0.1, 0, 0);
        std::size_t bodies = 0;
        const auto frame = [&] {
            motion.position += motion.velocity / 30;
            motion.angular_velocity.y() += 0.01;
            simulation.set_ground(0, motion);
            simulation.step(2);
            simulation.set_ground(0, motion, 0); // there at once
            simulation.step();
            bodies = simulation.positions().size();
        };
        CHECK(allocated(frame) == 0);
        CHECK(bodies == simulation.bodies());
        CHECK(simulation.step().finite());
    }
}

TEST_CASE("changing the step's length allocates nothing, nor does a step of that length") {
    for (SimulationOptions o : all_options()) {
        if (o.method == Method::analytic) continue; // whose steps are of one length
        CAPTURE_OPTIONS(o);
        Simulation simulation(one(leafy(), "gusty"), o);
        run(simulation, 4);
        const std::size_t before = allocations;
        simulation.set_step(1 / 50.0);
        const bool finite = simulation.step().finite();
        const std::size_t after = allocations; // before CHECK, which allocates itself
        CHECK(after == before);
        CHECK(finite);
    }
}
