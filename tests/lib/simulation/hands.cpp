// Pulls of a step and hands that take hold, against the scene's pulls and attachments.
#include "lib/simulation/simulation.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

TEST_CASE("a pull in each step is the scene's pull of that force, and ends with the step") {
    const Tree tree = make_tree::branched();
    const std::size_t body = tree.size_bodies() - 1;
    const Vec3 force(0.3, 0.1, -0.2), point(0, 0, tree.size[body][0]);
    for (const auto& [portable, precision] :
         {std::pair(false, Precision::double_), std::pair(true, Precision::double_),
          std::pair(false, Precision::single), std::pair(true, Precision::single)}) {
        SimulationOptions o;
        o.portable = portable;
        o.precision = precision;
        Scene pulled = one(tree);
        Pull pull;
        pull.on.body = std::int64_t(body);
        pull.on.point = point;
        pull.time = {0, 100};
        pull.force = {force, force};
        pulled.pulls = {pull};
        Simulation begun(pulled, o);
        o.pulls = true;
        Simulation by_hand(one(tree), o), still(one(tree), o);
        for (int k = 0; k < 20; ++k) {
            by_hand.pull(body, point, force);
            REQUIRE(by_hand.step().finite());
            REQUIRE(begun.step().finite());
            REQUIRE(still.step().finite());
        }
        const double moved = apart(by_hand.positions(), still.positions());
        CHECK(moved > 1e-4);
        // In single precision both round on their own: measured 3e-8 of the way, in double 1e-17.
        CHECK(apart(by_hand.positions(), begun.positions()) < (precision == Precision::single ? 1e-6 : 1e-12) * moved);
        by_hand.pull(body, point, force);
        for (int k = 0; k < 900; ++k) by_hand.step(); // let go, it comes back
        CHECK(apart(by_hand.positions(), still.positions()) < 1e-6);
        CHECK_THROWS_AS(by_hand.pull(tree.size_bodies(), point, force), SceneError);
        CHECK_THROWS_AS(by_hand.pull(body, point, Vec3(NAN, 0, 0)), SceneError);
        CHECK_THROWS_AS(begun.pull(body, point, force), SceneError);
    }
}

TEST_CASE("a hand that takes hold at any time is the scene's attachment, and let go leaves nothing behind") {
    const Tree tree = make_tree::branched();
    const std::size_t body = tree.size_bodies() - 1;
    const Vec3 point(0, 0, tree.size[body][0]);
    for (const bool portable : {false, true}) {
        SimulationOptions o;
        o.portable = portable;
        Scene held = one(tree, "breeze");
        Attachment attachment;
        attachment.on.body = std::int64_t(body);
        attachment.on.point = point;
        attachment.stiffness = 40;
        attachment.damping = 0.5;
        held.attachments = {attachment};
        Simulation begun(held, o), by_hand(one(tree, "breeze"), o), still(one(tree, "breeze"), o);
        const std::uint64_t hand = by_hand.attach(body, point, 40, 0.5);
        CHECK(hand > 0);
        CHECK(run(by_hand, 30) == run(begun, 30));
        CHECK(by_hand.attachment_force(hand).norm() > 0);
        run(still, 30);
        CHECK(by_hand.hash() != still.hash());

        // The target goes evenly: in ten steps, or in ten times one.
        Simulation stepwise = by_hand.copy();
        const Vec3 from = by_hand.positions()[body], to = from + Vec3(0.3, 0.1, -0.2);
        const Vec3 start = from + Vec3(0.1, 0, 0);
        by_hand.move_attachment(hand, start, 0);
        stepwise.move_attachment(hand, start, 0);
        by_hand.move_attachment(hand, to, 10);
        for (int k = 1; k <= 10; ++k) {
            stepwise.move_attachment(hand, start + k / 10.0 * (to - start), 1);
            by_hand.step();
            stepwise.step();
        }
        CHECK(apart(by_hand.positions(), stepwise.positions()) < 1e-9);
        by_hand.move_attachment(hand, from, 3);
        CHECK(by_hand.step().finite());
        // A run begun again keeps the hand, and lets it go by the same number.
        Simulation again(one(tree, "breeze"), o, by_hand);
        again.move_attachment(hand, to, 1);
        again.step();
        again.release(hand);
        CHECK_THROWS_AS(again.release(hand), SceneError);
        by_hand.release(hand);
        CHECK_THROWS_AS(by_hand.attachment_force(hand), SceneError);
        CHECK(by_hand.attach(body, point, 1, 0) != hand);
        by_hand.release(hand + 1);
        CHECK_THROWS_AS(by_hand.attach(tree.size_bodies(), point, 1, 0), SceneError);
        CHECK_THROWS_AS(by_hand.attach(body, Vec3(NAN, 0, 0), 1, 0), SceneError);
        CHECK_THROWS_AS(by_hand.attach(body, point, 0, 0), SceneError);
        CHECK_THROWS_AS(by_hand.attach(body, point, -1, 1), SceneError);
        run(by_hand, 900);
        run(still, 914);
        CHECK(apart(by_hand.positions(), still.positions()) < 0.2 * Vec3(0.3, 0.1, -0.2).norm());
    }
    SimulationOptions paper;
    paper.method = Method::analytic;
    Simulation analytic(one(tree), paper);
    CHECK_THROWS_AS(analytic.attach(body, point, 1, 0), SceneError);
    Scene held = one(tree);
    held.attachments.resize(1);
    held.attachments[0].stiffness = 1;
    held.attachments[0].on.body = 10000;
    CHECK_THAT(refusal(held), Catch::Contains("/attachments/0/on"));
}

TEST_CASE(
    "a hand's number is its simulation's: not given again after a state was restored, kept where one is refused") {
    const Tree tree = make_tree::branched();
    Simulation simulation(one(tree, "breeze"));
    run(simulation, 3);
    const SavedState saved = simulation.save();
    const std::uint64_t first = simulation.attach(3, Vec3::Zero(), 10, 1);
    const std::uint64_t second = simulation.attach(4, Vec3::Zero(), 10, 1);
    simulation.release(second);
    simulation.restore(saved);
    const std::uint64_t third = simulation.attach(4, Vec3::Zero(), 10, 1);
    CHECK(third != first);
    CHECK(third != second);
    CHECK_THROWS_AS(simulation.attachment_force(second), SceneError);

    Simulation other(one(tree, "breeze"));
    CHECK_THROWS_WITH(other.move_attachment(third, Vec3::Zero()), Catch::Contains("is not there"));
    const std::uint64_t own = other.attach(3, Vec3::Zero(), 10, 1);
    SavedState broken = saved;
    broken.theta_change.pop_back();
    CHECK_THROWS_AS(other.restore(broken), SceneError);
    CHECK(other.attachment_force(own).isZero(0)); // still there
    other.restore(saved);
    run(other, 5);
    CHECK(other.attachment_force(own).norm() > 0);
    Simulation begun(one(tree, "breeze"));
    begun.attach(3, Vec3::Zero(), 10, 1);
    begun.restore(saved);
    CHECK_THROWS_WITH(begun.settle(1), Catch::Contains("the run has begun"));
}

TEST_CASE("what has broken off is not pulled") {
    Scene scene = one(leafy(), "storm");
    scene.fracture = Fracture();
    scene.fracture->leaf = 1e-3;
    SimulationOptions o;
    o.pulls = true;
    Simulation simulation(scene, o);
    std::int64_t gone = -1;
    for (int k = 0; k < 30 && gone < 0; ++k) {
        REQUIRE(simulation.step().finite());
        for (std::size_t e = 0; e < simulation.events().what.size(); ++e)
            if (simulation.events().what[e] == "broke") gone = simulation.events().body[e];
    }
    REQUIRE(gone >= 0);
    CHECK_THROWS_WITH(simulation.pull(std::size_t(gone), Vec3::Zero(), Vec3(1, 0, 0)), Catch::Contains("broken off"));
    simulation.pull(0, Vec3::Zero(), Vec3(1, 0, 0));
    CHECK(simulation.step().finite());
}
