// Blocks that have settled sleep: where the tree's equilibrium is, at no cost, until something moves them; and the bits do not
// depend on threads or on a run being cut.
#include "lib/coupled/sleep.h"
#include "lib/base/parallel.h"
#include "tests/support/lanes_support.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_parts.h"
#include <set>

using namespace bough;
using namespace lanes;

namespace {

constexpr double rate = 1e-4; // [rad/s]

// Several blocks beside the top, strongly damped, so that a disturbed tree settles within seconds.
Case damped(double angle) {
    Case c{"damped", grown(12000), {}, angle, 0};
    c.scene.damping_scale = 20;
    return c;
}

template <class T = double> LanesRun<T> sleeping(const Case& c, double r = rate) {
    return LanesRun<T>(c, fast::best_target(), Scheme::p12, {}, Solver::coupled, r);
}

// [rad] Largest distance between two runs' angles.
double apart(const std::vector<Vec3>& one, const std::vector<Vec3>& other) {
    double most = 0;
    for (std::size_t i = 0; i < one.size(); ++i) most = std::max(most, (one[i] - other[i]).norm());
    return most;
}

std::size_t count(const State<double>& state, fast::Rest rest) {
    std::size_t n = 0;
    for (const fast::BlockRest& block : parts::lanes(state).rest) n += block.rest == rest;
    return n;
}

// The block that a body is in.
std::size_t block_of(const Plan<double>& plan, std::size_t body) {
    const fast::Layout& layout = parts::lanes(plan).layout;
    const std::size_t row = layout.slot[body] / std::size_t(layout.lanes);
    for (std::size_t b = 0; b < layout.blocks.size(); ++b)
        if (row >= layout.blocks[b].first_row && row < layout.blocks[b].end_row) return b;
    return 0;
}

Pull on_body(std::int32_t body, double start, double end, const Vec3& force) {
    Pull pull;
    pull.on.by = Selector::By::body;
    pull.on.body = body;
    pull.time = {start, start + 0.1, end - 0.1, end};
    pull.force = {Vec3::Zero(), force, force, Vec3::Zero()};
    return pull;
}

} // namespace

TEST_CASE("a tree that was bent and let go falls asleep at its equilibrium, and costs nothing from then on") {
    const Case c = damped(1e-3);
    LanesRun<> run = sleeping(c);
    REQUIRE(parts::lanes(run.plan).sleep.on);
    REQUIRE(parts::lanes(run.plan).layout.blocks.size() > 4);
    run.steps(20);
    CHECK(run.state.flags.asleep == 0); // not for the second that settling takes
    int steps = 20;
    for (; steps < 3000 && !fast::all_asleep(parts::lanes(run.state)); ++steps) run.steps(1);
    REQUIRE(fast::all_asleep(parts::lanes(run.state)));
    present(run.plan, run.state);
    // As drawn is in equilibrium. A slow mode, w rad/s, may be left at 2 r / w^2 (sleep.h); a joint of the crown has its share.
    CHECK(apart(run.state.theta, run.plan.theta_start) < rate);
    for (const Vec3& r : run.state.theta_dot) REQUIRE(r == Vec3::Zero());

    const std::uint64_t hash = run.hash(), calls = run.calls(Stage::lanes), asleep = run.state.flags.asleep;
    const std::int64_t step = run.state.step;
    run.steps(100);
    CHECK(run.calls(Stage::lanes) == calls);
    CHECK(parts::lanes(run.state).presented); // nothing to bring up to date
    CHECK(run.state.flags.asleep == asleep + 100 * run.plan.bodies);
    CHECK(run.state.step == step + 100);
    CHECK(run.hash() == hash);
}

TEST_CASE("nothing sleeps where it was not asked for, or where forces never rest; steady wind lets it") {
    const auto plan = [](const Scene& scene, double r) {
        return LanesRun<>({"", make_tree::branched(), scene}, fast::best_target(), Scheme::p12, {}, Solver::coupled, r)
            .plan;
    };
    Scene scene;
    CHECK(parts::lanes(plan(scene, rate)).sleep.on);
    CHECK(parts::lanes(plan(scene, 0)).sleep.reason == "not asked for");
    scene.wind = *wind_preset("calm");
    scene.wind->turbulence = 0;
    scene.wind->gust_factor = 1;
    CHECK(parts::lanes(plan(scene, rate)).sleep.on);
    scene.wind->turbulence = 0.1;
    CHECK(parts::lanes(plan(scene, rate)).sleep.reason == "/wind/turbulence");
    scene.wind->turbulence = 0;
    scene.wind->gust_factor = 1.5;
    CHECK(parts::lanes(plan(scene, rate)).sleep.reason == "/wind/gust_factor");
    scene.wind.reset();
    scene.root_motion = {shifted()};
    CHECK(parts::lanes(plan(scene, rate)).sleep.reason == "/root_motion");
}

TEST_CASE("a pull on a twig wakes its block and what carries it, a strong one the whole tree; the motion is the "
          "sleepless run's") {
    Case c = damped(0);
    const auto twig = std::int32_t(c.tree.size_bodies() - 1);
    c.scene.pulls = {on_body(twig, 2, 3, Vec3(1e-6, 0, 0)), on_body(5, 12, 13, Vec3(50, 0, 0))};
    LanesRun<> run = sleeping(c), sleepless = sleeping(c, 0);
    const std::size_t block = block_of(run.plan, std::size_t(twig)), blocks = parts::lanes(run.state).rest.size();
    REQUIRE(block > 0);
    run.steps(58);
    REQUIRE(fast::all_asleep(parts::lanes(run.state)));
    run.steps(8); // to 2.2 s
    CHECK(parts::lanes(run.state).rest[block].rest == fast::Rest::awake);
    CHECK(parts::lanes(run.state).rest[0].rest == fast::Rest::awake);
    CHECK(count(run.state, fast::Rest::asleep) == blocks - 2);
    run.steps(280); // to 11.5 s
    CHECK(fast::all_asleep(parts::lanes(run.state)));
    run.steps(40); // to 12.9 s
    CHECK(count(run.state, fast::Rest::awake) == blocks);
    sleepless.steps(int(run.state.step));
    present(run.plan, run.state);
    present(sleepless.plan, sleepless.state);
    CHECK(apart(sleepless.state.theta, sleepless.plan.theta_start) > 0.01);
    CHECK(apart(run.state.theta, sleepless.state.theta) < rate);
}

TEMPLATE_TEST_CASE("sleep's bits: any number of threads, a run cut anywhere", "", float, double) {
    using T = TestType;
    Case c = damped(1e-3);
    const auto twig = std::int32_t(c.tree.size_bodies() - 1);
    c.scene.pulls = {on_body(twig, 2, 3, Vec3(1e-6, 0, 0))};
    const T loose = T(5e-3); // [rad/s] blocks fall asleep one after the other
    constexpr int frames = 150;
    LanesRun<T> run = sleeping<T>(c, loose);
    std::vector<std::uint64_t> hashes;
    std::set<std::size_t> sleepers; // how many at a time
    for (int k = 0; k < frames; ++k) {
        run.steps(1);
        std::size_t n = 0;
        for (const fast::BlockRest& block : parts::lanes(run.state).rest) n += block.rest == fast::Rest::asleep;
        sleepers.insert(n);
        hashes.push_back(run.hash());
    }
    REQUIRE(sleepers.size() > 2);
    for (const int threads : ::cases<int>(2, {3, 1, 2, 8, 15})) {
        const ThreadLimit limit(threads);
        LanesRun<T> other = sleeping<T>(c, loose);
        other.steps(frames);
        CHECK(other.hash() == hashes.back());
    }
    LanesRun<T> first = sleeping<T>(c, loose);
    for (int cut = 1; cut < frames; ++cut) {
        first.steps(1);
        if (cut % 13 != 0 && parts::lanes(first.state).rest[0].rest != fast::Rest::settling) continue;
        CAPTURE(cut);
        present(first.plan, first.state);
        Case still = c;
        still.angle = 0;
        LanesRun<T> resumed = sleeping<T>(still, loose);
        resumed.state.step = first.state.step;
        resumed.state.theta = first.state.theta;
        resumed.state.theta_dot = first.state.theta_dot;
        parts::theta_change(resumed.state) = parts::theta_change(first.state);
        parts::theta_dot_change(resumed.state) = parts::theta_dot_change(first.state);
        restart(resumed.plan, resumed.state);
        parts::restore_sleep(resumed.plan, resumed.state, parts::saved_sleep(first.plan, first.state));
        const int some = std::min(frames - cut, 40);
        resumed.steps(some);
        REQUIRE(resumed.hash() == hashes[std::size_t(cut + some - 1)]);
    }
}

TEST_CASE("a state that slept and is started anew steps as one that did not") {
    const Case c = damped(1e-3);
    LanesRun<> slept = sleeping(c), fresh = sleeping(c);
    for (int k = 0; k < 3000 && !fast::all_asleep(parts::lanes(slept.state)); ++k) slept.steps(1);
    REQUIRE(fast::all_asleep(parts::lanes(slept.state)));
    present(slept.plan, slept.state);
    fresh.state.theta = slept.state.theta;
    parts::theta_change(fresh.state) = parts::theta_change(slept.state);
    parts::theta_dot_change(fresh.state) = parts::theta_dot_change(slept.state);
    for (LanesRun<>* run : {&slept, &fresh}) {
        run->state.step = 0;
        for (Vec3& theta_dot : run->state.theta_dot) theta_dot = Vec3(0.1, -0.2, 0.05);
        restart(run->plan, run->state);
        run->steps(5);
    }
    CHECK(slept.hash() == fresh.hash());
}

TEST_CASE("what is no sleep of this plan's is refused") {
    const Case c = damped(1e-3);
    LanesRun<> run = sleeping(c);
    for (int k = 0; k < 3000 && count(run.state, fast::Rest::asleep) == 0; ++k) run.steps(1);
    const std::vector<double> good = parts::saved_sleep(run.plan, run.state);
    REQUIRE(good.size() > 2);
    LanesRun<> other = sleeping(c);
    CHECK_NOTHROW(parts::restore_sleep(other.plan, other.state, good));
    CHECK_NOTHROW(parts::restore_sleep(other.plan, other.state, {}));
    std::vector<double> wrong = good;
    wrong.pop_back();
    CHECK_THROWS_AS(parts::restore_sleep(other.plan, other.state, wrong), std::invalid_argument);
    wrong = good;
    wrong.push_back(0);
    CHECK_THROWS_AS(parts::restore_sleep(other.plan, other.state, wrong), std::invalid_argument);
    wrong = good;
    wrong[1] = 3;
    CHECK_THROWS_AS(parts::restore_sleep(other.plan, other.state, wrong), std::invalid_argument);
    wrong = good;
    wrong[2] = 0.5;
    CHECK_THROWS_AS(parts::restore_sleep(other.plan, other.state, wrong), std::invalid_argument);
    LanesRun<> sleepless = sleeping(c, 0);
    CHECK_THROWS_AS(parts::restore_sleep(sleepless.plan, sleepless.state, good), std::invalid_argument);
}
