// What is free in a scene, as a whole (world.h): cut in two and put together again, and not there where a scene has nothing of it.
#include "lib/free/world.h"
#include "tests/support/free_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace free_bodies;

TEMPLATE_TEST_CASE("A run that is cut goes on in the same bits", "", float, double) {
    const Way way = GENERATE(from_range(ways));
    INFO(name(way));
    const Tree tree = make_tree::random_tree(150, 8);
    FreeRun<TestType> whole(tree, lively(), way), first(tree, lively(), way), second(tree, lively(), way);
    whole.steps(40);
    first.steps(17);
    REQUIRE(first.world.broken.size() > 2);
    present(first.plan, first.state);
    restore_world(second.plan, second.state, second.world, saved_world(first.state, first.world));
    second.state.step = first.state.step;
    second.state.theta = first.state.theta;
    second.state.theta_dot = first.state.theta_dot;
    parts::theta_change(second.state) = parts::theta_change(first.state);
    parts::theta_dot_change(second.state) = parts::theta_dot_change(first.state);
    parts::scaled_rate(second.state) = parts::scaled_rate(first.state);
    restart(second.plan, second.state);
    CHECK(second.hash() == first.hash());
    second.steps(23);
    CHECK(second.hash() == whole.hash());
    CHECK(second.world.broken == whole.world.broken);
}

TEST_CASE("A saved world that does not fit is refused") {
    const Tree tree = make_tree::branched();
    FreeRun<> run(tree, lively(), ways[0]);
    run.steps(20);
    const std::vector<double> good = saved_world(run.state, run.world);
    const auto refused = [&](const std::vector<double>& saved) {
        FreeRun<> fresh(tree, lively(), ways[0]);
        CHECK_THROWS_AS(restore_world(fresh.plan, fresh.state, fresh.world, saved), std::invalid_argument);
    };
    refused({});
    refused({good.begin(), good.end() - 1});
    std::vector<double> longer = good;
    longer.push_back(1);
    refused(longer);
    std::vector<double> wrong = good;
    wrong[1] = 1e9;
    refused(wrong);
}

TEST_CASE("Without fracture and balls there is nothing: no calls, no bytes, the same hash as ever") {
    const Tree tree = make_tree::branched();
    Scene scene;
    scene.wind = *wind_preset("gusty");
    for (const Way& way : ways) {
        FreeRun<> run(tree, scene, way);
        CHECK(!run.world.on());
        CHECK(run.world.bytes() == 0);
        run.steps(3);
        for (const Stage stage : {Stage::free_flight, Stage::contacts, Stage::fracture})
            CHECK(run.state.calls[std::size_t(stage)] == 0);
        State<double> state = make_state(run.plan);
        for (int k = 0; k < 3; ++k) advance(run.plan, state);
        CHECK(run.hash() == state_hash(run.plan, state));
        for (const PlannedStage& stage : explain(run.plan).stages)
            if (stage.stage == Stage::fracture) CHECK(!stage.on);
    }
}
