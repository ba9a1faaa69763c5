// The bits of a step in lanes, coupled and analytic: the same for any number of threads, for a run cut in two, for the same run twice, and
// whenever the arrays in document order are brought up to date.
#include "lib/base/parallel.h"
#include "tests/support/lanes_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace lanes;

namespace {

constexpr int frames = 6;

// Large enough for several blocks beside the top.
const Case& large() {
    static const Case c{"grown", grown(20500), everything()};
    return c;
}

// Leaves that turn fast: the energy guard has work.
const Case& flapping() {
    static const Case c = [] {
        Case made{"flapping", grown(20500), {}, 0.1, 20};
        made.scene.wind = gusts();
        return made;
    }();
    return c;
}

// The analytic step's: gusts and pulls, leaves that the energy guard and half turns have to do with.
const Case& paper() {
    static const Case c = [] {
        Case made{"analytic", grown(20500), {}, 0.1, 20};
        made.scene.wind = gusts();
        made.scene.pulls = pulls();
        made.solver = Solver::analytic;
        return made;
    }();
    return c;
}

template <class T> LanesRun<T> run_of(const Case& c) {
    return LanesRun<T>(c, fast::best_target());
}

} // namespace

TEMPLATE_TEST_CASE("the same run in lanes twice is the same", "", float, double) {
    for (const Case* c : {&large(), &flapping(), &paper()}) {
        CAPTURE(c->name);
        LanesRun<TestType> one = run_of<TestType>(*c), other = run_of<TestType>(*c);
        REQUIRE(one.plan.stepper->in_lanes());
        REQUIRE(one.plan.bodies >= 20000);
        REQUIRE(parts::lanes(one.plan).layout.blocks.size() > 4);
        const std::uint64_t start = one.hash();
        one.steps(frames);
        other.steps(frames);
        CHECK(one.hash() == other.hash());
        CHECK(one.hash() != start);
        CHECK_FALSE(first_non_finite(one.state).has_value());
        CHECK(one.calls(Stage::lanes) == frames);
    }
}

TEMPLATE_TEST_CASE("reading the arrays at each step changes nothing", "", float, double) {
    for (const Case* c : {&large(), &paper()}) {
        CAPTURE(c->name);
        LanesRun<TestType> watched = run_of<TestType>(*c), alone = run_of<TestType>(*c);
        for (int k = 0; k < frames; ++k) watched.frame();
        alone.steps(frames);
        CHECK(watched.hash() == alone.hash());
        // Poses too, and a second time brings nothing new.
        for (std::size_t i = 0; i < alone.plan.bodies; ++i) REQUIRE(watched.state.x_w[i] == alone.state.x_w[i]);
        const std::uint64_t hash = alone.hash();
        present(alone.plan, alone.state);
        CHECK(state_hash(alone.state) == hash);
    }
}

TEMPLATE_TEST_CASE("a run in lanes cut in two goes on as if it had not been", "", float, double) {
    for (const Case* c : {&large(), &flapping(), &paper()}) {
        CAPTURE(c->name);
        LanesRun<TestType> whole = run_of<TestType>(*c), forgetful = run_of<TestType>(*c);
        Case calm = *c; // a fresh state, not shaken
        calm.angle = calm.rate = 0;
        LanesRun<TestType> resumed = run_of<TestType>(calm);
        whole.steps(frames);
        const std::uint64_t cut = whole.hash();
        for (LanesRun<TestType>* run : {&resumed, &forgetful}) {
            run->state.step = whole.state.step;
            run->state.theta = whole.state.theta;
            run->state.theta_dot = whole.state.theta_dot;
            if (run == &resumed) {
                parts::theta_change(run->state) = parts::theta_change(whole.state);
                parts::theta_dot_change(run->state) = parts::theta_dot_change(whole.state);
                parts::scaled_rate(run->state) = parts::scaled_rate(whole.state);
            }
            restart(run->plan, run->state);
            CHECK(run->hash() == cut);
        }
        for (int k = 0; k < frames; ++k) {
            whole.steps(1);
            resumed.steps(1);
            forgetful.steps(1);
            CAPTURE(k);
            CHECK(whole.hash() == resumed.hash());
            CHECK(whole.state.x_w[777] == resumed.state.x_w[777]);
        }
        // The last changes are state, or the scaled rates.
        CHECK(whole.hash() != forgetful.hash());
    }
}

TEMPLATE_TEST_CASE("the number of threads does not change a bit of what lanes find", "", float, double) {
    for (const Case* c : {&large(), &flapping(), &paper()}) {
        std::uint64_t one_thread = 0, guarded = 0;
        for (const int threads : {1, 2, 3, 8, 15}) {
            const ThreadLimit limit(threads);
            LanesRun<TestType> run = run_of<TestType>(*c);
            run.steps(frames);
            CAPTURE(c->name, threads);
            if (threads == 1) {
                one_thread = run.hash();
                guarded = run.state.flags.energy_guard;
                REQUIRE_FALSE(first_non_finite(run.state).has_value());
            }
            CHECK(run.hash() == one_thread);
            CHECK(run.state.flags.energy_guard == guarded);
        }
    }
}
