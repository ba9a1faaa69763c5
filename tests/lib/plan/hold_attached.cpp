// Holding joints by error where attachments hold the tree too: what they push is left to move.
#include "lib/lanes/target.h"
#include "lib/laws/added_motion.h"
#include "lib/plan/hold.h"
#include "lib/study/rigid_error.h"
#include "lib/study/solvers.h"
#include "tests/support/held_joints.h"
#include "tests/support/paper_trees.h"
#include "tests/support/reduced.h"
#include <catch2/catch.hpp>

using namespace bough;
using held_joints::run_both;
using reduced::all_of;

namespace {

// A rope of 200 N/m from a branch's end to where that is drawn.
Attachment rope_at(std::int64_t body) {
    Attachment rope;
    rope.on.body = body;
    rope.stiffness = 200;
    rope.damping = 2;
    return rope;
}

std::size_t last_end(const Tree& tree) {
    return std::size_t(tree.size_bodies() - 1);
}

} // namespace

TEST_CASE("what is attached keeps the joints between it and the ground moving, whatever the error") {
    Tree tree = paper_trees::branched(2e9, 0.003);
    Scene scene;
    scene.wind = wind_preset("gusty");
    scene.simulate.emplace().error = 1e3; // which holds all else
    const std::size_t end = last_end(tree);
    scene.attachments.push_back(rope_at(std::int64_t(end)));
    const HeldJoints count = hold_rigid(tree, all_of(tree), scene);
    std::vector<bool> between(tree.size_bodies());
    for (std::int64_t i = std::int64_t(end); i >= 0; i = tree.parent[std::size_t(i)]) between[std::size_t(i)] = true;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) CHECK((tree.rigid[i] == 0) == between[i]);
    CHECK((count.moving > 1 && count.error > 1));

    // Of a pair both ends' ways.
    Tree tied = paper_trees::branched(2e9, 0.003);
    Selector other;
    other.body = std::int64_t(end / 2);
    scene.attachments[0].with = other;
    hold_rigid(tied, all_of(tied), scene);
    for (std::int64_t i = other.body; i >= 0; i = tied.parent[std::size_t(i)]) CHECK(tied.rigid[std::size_t(i)] == 0);
}

TEST_CASE("holding by error holds no more than it says of a tree that a rope holds") {
    for (const double error : {0.003, 0.01, 0.03}) {
        Tree tree = paper_trees::branched(2e9, 0.003);
        Scene scene;
        scene.wind = wind_preset("gusty");
        scene.simulate.emplace().error = error;
        scene.attachments.push_back(rope_at(std::int64_t(last_end(tree))));
        const HeldJoints count = hold_rigid(tree, all_of(tree), scene);
        INFO("error " << error << ": " << text_of(count));
        REQUIRE((count.moving > 0 && count.error > 0));
        scene.simulate.reset(); // is applied
        const double worst = run_both(tree, scene, 600).worst;
        CHECK(worst < error);
        CHECK(worst > 0);
    }
}

TEST_CASE("a target that moves has no estimate, one at rest has") {
    Scene scene;
    scene.wind = wind_preset("gusty");
    scene.attachments.push_back(rope_at(3));
    CHECK(no_estimate(scene).empty());
    scene.attachments[0].time = {0, 1};
    scene.attachments[0].position = {Vec3(0, 1, 0), Vec3(1, 1, 0)};
    CHECK(no_estimate(scene) == "its estimate knows nothing of /attachments whose targets move");
    scene.attachments.clear();
    scene.wind.reset();
    scene.attachments.push_back(rope_at(3)); // which moves nothing
    CHECK_FALSE(no_estimate(scene).empty());
}
