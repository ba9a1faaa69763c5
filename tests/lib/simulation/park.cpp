// Many trees as one: each moves as it does alone, to the last bit, whatever stands beside it; the parts that a park is cut into.
#include "lib/model/append.h"
#include "lib/simulation/parts.h"
#include "tests/support/lanes_support.h"
#include "tests/support/sanitized.h"

using namespace bough;

TEST_CASE("trees of a park move as alone, to the last bit, on both paths") {
    const Solver solver = GENERATE(Solver::coupled, Solver::analytic);
    const lanes::Simd simd = GENERATE(lanes::Simd(), lanes::Simd(fast::Target::baseline));
    lanes::Case park{"", lanes::grown(700), {}};
    park.solver = solver;
    park.scene.wind = *wind_preset("storm");
    park.scene.wind->profile = 0; // the table over height is made for the tallest
    // Of many bodies blocks are larger, which must not show in any tree.
    std::vector<Tree> alone{park.tree};
    for (const std::int64_t bodies : cases<std::int64_t>(2, {300, 2500, 30000, 9000}))
        alone.push_back(lanes::grown(bodies));
    park.ranges = {{0, alone[0].size_bodies(), 0}};
    for (std::size_t k = 1; k < alone.size(); ++k) {
        const std::size_t first = append(park.tree, alone[k], Vec3(0, 0, 0), 0);
        park.ranges.push_back({first, alone[k].size_bodies(), 100000 * std::int32_t(k)});
    }
    lanes::LanesRun<float> joined(park, simd);
    joined.steps(15);
    present(joined.plan, joined.state);
    for (std::size_t k = 0; k < alone.size(); ++k) {
        lanes::Case one{"", alone[k], park.scene};
        one.solver = solver;
        lanes::LanesRun<float> run(one, simd);
        run.steps(15);
        present(run.plan, run.state);
        CHECK(std::equal(run.state.theta.begin(), run.state.theta.end(),
                         joined.state.theta.begin() + std::ptrdiff_t(park.ranges[k].first_body)));
    }
}

TEST_CASE("parts hold every tree once, about as many bodies each, none empty") {
    const std::vector<std::vector<std::size_t>> parks{
        {10}, {1, 1, 1, 1, 1, 1, 1}, {1000, 1, 1, 1}, {1, 1, 1, 1000}, {5, 80, 3, 40, 40, 9, 120, 1}};
    for (const std::vector<std::size_t>& bodies : parks)
        for (std::int32_t parts = 1; parts <= std::int32_t(bodies.size()); ++parts) {
            std::size_t next = 0, most = 0, all = 0, largest = 0;
            for (std::int32_t part = 1; part <= parts; ++part) {
                Part p;
                p.part = part;
                p.parts = parts;
                const auto [first, end] = units_of_part(bodies, p);
                CHECK(first == next);
                CHECK(end > first);
                next = end;
                std::size_t held = 0;
                for (std::size_t k = first; k < end; ++k) held += bodies[k];
                most = std::max(most, held);
            }
            CHECK(next == bodies.size());
            for (const std::size_t n : bodies) all += n, largest = std::max(largest, n);
            CHECK(most <= all / std::size_t(parts) + 2 * largest);
        }
}

TEST_CASE("a scene is cut before a tree where those since the last cut have 256 bodies") {
    CHECK(cuts({{300, {0}}, {10, {0}}, {246, {0}}, {5, {0}}, {1000, {0}}}) == std::vector<std::size_t>{0, 1, 3});
    // Trees of several roots: the stand that begins at the second trunk goes on into the next tree.
    CHECK(cuts({{400, {0, 300}}, {10, {0}}, {200, {0}}, {3, {0}}}) == std::vector<std::size_t>{0, 3});
}

TEST_CASE("a part of a scene has what concerns its trees, under their new numbers") {
    Scene scene;
    scene.trees.resize(4);
    scene.pulls.resize(3);
    scene.pulls[0].on.tree = 0;
    scene.pulls[1].on.tree = 2;
    scene.pulls[2].on.tree = 3;
    scene.root_motion.resize(2);
    scene.root_motion[0].tree = 1;
    scene.root_motion[1].tree = 2;
    const Scene part = scene_of_part(scene, 2, 4);
    REQUIRE(part.pulls.size() == 2);
    CHECK((part.pulls[0].on.tree == 0 && part.pulls[1].on.tree == 1));
    REQUIRE(part.root_motion.size() == 1);
    CHECK(part.root_motion[0].tree == 0);
    CHECK(part.trees.size() == 2);
    scene.attachments.resize(1);
    scene.attachments[0].on.tree = 3;
    scene.attachments[0].with = Selector();
    scene.attachments[0].with->tree = 3;
    CHECK(scene_of_part(scene, 2, 4).attachments[0].with->tree == 1);
    scene.attachments[0].with->tree = 1;
    CHECK_THROWS_WITH(scene_of_part(scene, 2, 4), Catch::Contains("/attachments/0/with"));
    scene.attachments.clear();
    scene.pulls[0].on.by = Selector::By::nearest;
    CHECK_THROWS_WITH(scene_of_part(scene, 2, 4), Catch::Contains("/pulls/0/on"));
    scene.pulls.clear();
    scene.balls.resize(1);
    CHECK_THROWS_WITH(scene_of_part(scene, 2, 4), Catch::Contains("/balls"));
    scene.balls.clear();
    scene.wind.emplace();
    scene.wind->shelter.emplace();
    CHECK_THROWS_WITH(scene_of_part(scene, 2, 4), Catch::Contains("/wind/shelter"));
}
