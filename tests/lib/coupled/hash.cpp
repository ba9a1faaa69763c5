// The coupled step's bits: the same for any number of threads, for a run cut in two, and for the same run twice.
#include "lib/base/parallel.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "tests/support/coupled_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace coupled;

namespace {

Tree grown_tree(std::int64_t bodies) {
    return segment(grow_bodies(default_growth(), 7, {true, false, true}, bodies), wood_presets().front(), {});
}

// Gravity, gusts with leaves, pulls and a moving ground.
Scene scene_of_all() {
    Scene scene;
    scene.wind = wind_preset("gusty");
    scene.wind->turbulence = 0.2;
    scene.pulls = {pull_on(3, Vec3(1, 0, -4), Vec3(-8, 1, 2))};
    RootMotion keys;
    keys.time = {0, 0.5, 1};
    keys.position = {Vec3::Zero(), Vec3(0.1, 0.02, -0.1), Vec3(0.15, 0, 0)};
    keys.rotation = {Quat::Identity(), make_tree::turn(0.2, Vec3(1, 2, 0)), make_tree::turn(0.1, Vec3(0, 2, 1))};
    scene.root_motion = {keys};
    return scene;
}

constexpr std::array<Scheme, 3> kinds{Scheme::p12, Scheme::p34, Scheme::lie}; // one pole, two, a real one

} // namespace

TEMPLATE_TEST_CASE("the same run twice is the same", "", float, double) {
    for (const Scheme scheme : kinds) {
        CoupledRun<TestType> one(grown_tree(300), scene_of_all(), scheme),
            other(grown_tree(300), scene_of_all(), scheme);
        const std::uint64_t start = state_hash(one.state);
        one.steps(10);
        other.steps(10);
        CAPTURE(scheme_of(scheme).name);
        REQUIRE_FALSE(first_non_finite(one.state).has_value());
        CHECK(state_hash(one.state) != start);
        CHECK(state_hash(one.state) == state_hash(other.state));
    }
}

TEMPLATE_TEST_CASE("a run cut in two goes on as if it had not been", "", float, double) {
    const Tree tree = grown_tree(300);
    for (const Scheme scheme : kinds) {
        CoupledRun<TestType> whole(tree, scene_of_all(), scheme), resumed(tree, scene_of_all(), scheme),
            forgetful(tree, scene_of_all(), scheme);
        whole.steps(10);
        for (CoupledRun<TestType>* run : {&resumed, &forgetful}) {
            run->state.step = whole.state.step;
            run->state.theta = whole.state.theta;
            run->state.theta_dot = whole.state.theta_dot;
            if (run == &forgetful) continue;
            parts::theta_change(run->state) = parts::theta_change(whole.state);
            parts::theta_dot_change(run->state) = parts::theta_dot_change(whole.state);
        }
        for (int k = 0; k < 10; ++k) {
            whole.steps(1);
            resumed.steps(1);
            CAPTURE(scheme_of(scheme).name, k);
            CHECK(state_hash(whole.state) == state_hash(resumed.state));
        }
        // The last changes are state, where the scheme extrapolates.
        forgetful.steps(10);
        REQUIRE_FALSE(first_non_finite(whole.state).has_value());
        CHECK((state_hash(whole.state) != state_hash(forgetful.state)) == scheme_of(scheme).extrapolates);
    }
}

TEMPLATE_TEST_CASE("the number of threads does not change a bit", "", float, double) {
    const Tree tree = grown_tree(5000); // enough for the step to use several
    for (const Scheme scheme : kinds) {
        std::uint64_t one_thread = 0;
        for (const int threads : {1, 2, 3, 8}) {
            const ThreadLimit limit(threads);
            CoupledRun<TestType> run(tree, scene_of_all(), scheme);
            run.steps(10);
            CAPTURE(scheme_of(scheme).name, threads);
            if (threads == 1) {
                one_thread = state_hash(run.state);
                REQUIRE_FALSE(first_non_finite(run.state).has_value());
                CHECK(run.state.theta_dot[2500].norm() > 0);
            }
            CHECK(state_hash(run.state) == one_thread);
        }
    }
}
