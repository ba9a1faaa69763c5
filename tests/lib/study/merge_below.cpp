// Joints merged by a trial run: what is found is within what was asked for, seen by another run.
#include "lib/study/merge_below.h"
#include "lib/study/solvers.h"
#include "tests/support/make_tree.h"
#include "tests/support/paper_trees.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

std::vector<TreeRange> all_of(const Tree& tree) {
    return {{0, tree.size_bodies(), 0}};
}

MergeBelow by(double error, const Scene& scene, double seconds = 4) {
    MergeBelow how;
    how.error = error;
    how.scene = scene;
    how.seconds = seconds;
    return how;
}

std::size_t moving(const Tree& tree) {
    return tree.size_bodies() - std::size_t(std::count(tree.rigid.begin(), tree.rigid.end(), 1));
}

// Largest distance of the far ends of branches without branches, body frames taken along by hand.
double farthest_tip(const Tree& merged, const Scene& scene, double seconds) {
    Tree whole = merged;
    whole.rigid.clear();
    const Reduced r = reduce(merged, all_of(merged), scene);
    const auto plan = [&](const Tree& t) {
        return make_plan<double>(t, all_of(t), scene, {}, 1.0 / 30, Solver::coupled);
    };
    const Plan<double> a = plan(whole), b = plan(r.tree);
    State<double> there = make_state(a), here = make_state(b);
    std::vector<bool> bears(whole.size_bodies(), false);
    for (std::size_t i = 0; i < bears.size(); ++i)
        if (whole.parent[i] >= 0) bears[std::size_t(whole.parent[i])] = true;
    double worst = 0;
    std::vector<Mat3> R(bears.size());
    std::vector<Vec3> x(bears.size());
    for (int f = 0; f < int(30 * seconds + 0.5); ++f) {
        advance(a, there);
        advance(b, here);
        for (std::size_t i = 0; i < bears.size(); ++i) {
            if (!merged.rigid[i]) {
                R[i] = here.R_wb[std::size_t(r.body[i])];
                x[i] = here.x_w[std::size_t(r.body[i])];
            } else {
                const auto p = std::size_t(merged.parent[i]);
                R[i] = R[p] * merged.joint_rotation[i].toRotationMatrix();
                x[i] = x[p] + R[p] * merged.joint_position[i];
            }
            const Vec3 end = there.x_w[i] + there.R_wb[i].col(2) * whole.size[i][0];
            if (!bears[i]) worst = std::max(worst, (end - x[i] - R[i].col(2) * whole.size[i][0]).norm());
        }
    }
    return worst;
}

} // namespace

TEST_CASE("merging stays below the error, and more is merged for more of it") {
    const Tree drawn = paper_trees::branched(2e9, 0.003); // branches alone
    Scene scene;
    scene.wind = wind_preset("gusty");
    std::size_t before = drawn.size_bodies() + 1;
    for (const double error : {0.001, 0.01, 0.1}) {
        Tree tree = drawn;
        const MergedBelow merged = merge_below(tree, all_of(tree), by(error, scene));
        INFO("error " << error << ": " << merged.moving << " left, found " << merged.found.worst << " in "
                      << merged.runs << " runs");
        CHECK(merged.joints == drawn.size_bodies());
        CHECK(merged.moving == moving(tree));
        CHECK((merged.runs >= 1 && merged.runs <= 16));
        REQUIRE(!tree.rigid.empty());
        CHECK(merged.found.frames == 120);
        CHECK(merged.found.worst <= error);
        CHECK(merged.found.rms <= merged.found.worst);
        if (tree.rigid[0] == 0) CHECK(farthest_tip(tree, scene, 4) == Approx(merged.found.worst).epsilon(1e-3));
        CHECK(moving(tree) < before);
        before = moving(tree);
        tree.rigid.clear();
    }
}

TEST_CASE("a chain with two soft joints keeps these two") {
    Tree tree = paper_trees::chain(2e12, 0.003, 12);
    for (const std::size_t soft : {std::size_t(0), std::size_t(7)}) tree.stiffness[soft] *= 1e-3;
    Scene scene;
    scene.wind = wind_preset("gusty");
    const MergedBelow merged = merge_below(tree, all_of(tree), by(0.002, scene));
    INFO(merged.moving << " left, found " << merged.found.worst);
    REQUIRE(tree.rigid.size() == 12);
    for (std::size_t i = 0; i < 12; ++i) CHECK(tree.rigid[i] == (i == 0 || i == 7 ? 0 : 1));
}

TEST_CASE("nothing is merged where nothing may be, and earlier merging is forgotten") {
    Tree tree = paper_trees::branched(2e9, 0.003);
    tree.rigid.assign(tree.size_bodies(), 1);
    Scene scene;
    scene.wind = wind_preset("storm");
    const MergedBelow merged = merge_below(tree, all_of(tree), by(1e-9, scene, 1));
    CHECK(tree.rigid.empty());
    CHECK(merged.moving == merged.joints);
    CHECK(merged.found.frames == 0);
}

TEST_CASE("a tick sees each frame and may end it") {
    Tree tree = paper_trees::branched(2e9, 0.003);
    Scene scene;
    scene.wind = wind_preset("gusty");
    MergeBelow how = by(0.01, scene, 1);
    std::int64_t last = 0;
    how.tick = [&](std::int64_t frame, std::int64_t frames) {
        CHECK(frame == last + 1);
        CHECK(frame <= frames);
        last = frame;
    };
    merge_below(tree, all_of(tree), how);
    CHECK(last >= 60);
    how.tick = [](std::int64_t, std::int64_t) { throw std::runtime_error("enough"); };
    CHECK_THROWS_WITH(merge_below(tree, all_of(tree), how), "enough");
}
