// Trees that are ahead in the wind: each moves as it does alone, begun that much later.
#include "lib/model/append.h"
#include "tests/support/coupled_support.h"
#include "tests/support/lanes_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace lanes;

namespace {

Wind gusty(bool varied) {
    Wind wind = *wind_preset("gusty");
    if (!varied) return wind;
    WindGrid grid;
    grid.x = grid.z = -6;
    grid.cell = 3;
    grid.columns = grid.rows = 4;
    for (int k = 0; k < 16; ++k) {
        grid.velocity.push_back(Vec3(7 + 0.1 * k, 0, 1 - 0.2 * k));
        grid.phase.push_back(0.3 * k);
    }
    grid.octaves = {2};
    wind.grid = grid;
    wind.swirl.emplace();
    wind.swirl->angle = {25};
    wind.swirl->wavelength = 5;
    return wind;
}

Tree small() {
    return coupled::leafy(2e9, 0.02);
}

} // namespace

TEST_CASE("a tree that is ahead in the wind moves as one that begins later") {
    const bool varied = GENERATE(false, true);
    const Solver solver = GENERATE(Solver::coupled, Solver::analytic);
    const Simd simd = GENERATE(Simd(), Simd(Target::baseline));
    CAPTURE(varied, solver_name(solver), simd.has_value());
    constexpr int later = 45; // steps
    Case both{"", small(), {}};
    both.solver = solver;
    both.scene.wind = gusty(varied);
    for (const double start : {0.0, later / 30.0, 0.0}) both.scene.trees.push_back({"", Vec3::Zero(), 0, start});
    const std::size_t n = both.tree.size_bodies();
    both.ranges = {{0, n, 0}};
    for (const Vec3& place : {Vec3(2.2, 0, -1), Vec3(-3, 0, 2)})
        both.ranges.push_back({append(both.tree, small(), place, 0), n, 10 * std::int32_t(both.ranges.size())});
    LanesRun<> run(both, simd);
    run.steps(20);
    present(run.plan, run.state);
    for (std::size_t k = 0; k < 3; ++k) {
        Case alone{"", small(), both.scene};
        alone.solver = solver;
        alone.tree.joint_position[0] = both.tree.joint_position[both.ranges[k].first_body];
        alone.scene.trees.clear();
        Wishes tables; // of the same heights and distances
        tables.top = run.plan.top;
        tables.reach = run.plan.reach;
        LanesRun<> one(alone, Simd(), Scheme::p12, tables);
        one.state.step = k == 1 ? later : 0;
        restart(one.plan, one.state);
        one.steps(20);
        double apart = 0, moved = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 theta = run.state.theta[both.ranges[k].first_body + i];
            apart = std::max(apart, (theta - one.state.theta[i]).norm());
            moved = std::max(moved, (theta - one.plan.theta_start[i]).norm());
        }
        CHECK(moved > 1e-3);
        CHECK(apart < 1e-9 * moved);
    }
}

TEST_CASE("trees that all begin together have one clock, and nothing is kept for more") {
    Case c{"", small(), {}};
    c.scene.wind = gusty(false);
    c.scene.trees.resize(1);
    const LanesRun<> run(c, Simd(Target::baseline));
    CHECK(run.plan.clocks == std::vector<double>{0});
    CHECK(run.plan.clock.empty());
    CHECK(parts::lanes(run.plan).clock.empty());
    CHECK_FALSE(run.plan.field);
    c.scene.trees[0].start = 3;
    CHECK(LanesRun<>(c, Simd(Target::baseline)).plan.field);
}

TEST_CASE("more entries than can be looked up are refused") {
    Scene scene;
    scene.wind = gusty(true);
    scene.wind->swirl.reset();
    scene.wind->grid->columns = scene.wind->grid->rows = 1000;
    scene.wind->grid->velocity.clear();
    scene.wind->grid->phase = {0};
    std::vector<double> clocks{0, 1, 2, 3};
    CHECK_NOTHROW(make_wind_field<float>(*scene.wind, 1, clocks));
    clocks.push_back(4);
    CHECK_THROWS_WITH(make_wind_field<float>(*scene.wind, 1, clocks), Catch::Contains("wind/grid"));
}
