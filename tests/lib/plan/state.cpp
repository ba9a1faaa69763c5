// The state's hash against FNV-1a written here; the same hash for any number of threads and for a run cut in two.
#include "lib/plan/state.h"
#include "lib/base/parallel.h"
#include "lib/plan/ground.h"
#include "lib/study/solvers.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

using namespace bough;
using namespace solver;

namespace {

// FNV-1a, 64 bits, over the bytes as they lie in memory (little-endian machines).
template <class T> std::uint64_t fnv(const std::vector<const std::vector<Vector3<T>>*>& arrays) {
    std::uint64_t hash = 14695981039346656037u;
    for (const auto* array : arrays)
        for (const Vector3<T>& v : *array) {
            unsigned char bytes[3 * sizeof(T)];
            std::memcpy(bytes, v.data(), sizeof bytes);
            for (unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211u;
        }
    return hash;
}

Scene gusty() {
    Scene scene;
    scene.wind = wind_preset("gusty");
    scene.pose = Pose::rest;
    return scene;
}

// The random trees' thinnest twigs are of rubber otherwise.
Scene stiff_gusty() {
    Scene scene = gusty();
    scene.stiffness_scale = 1e6;
    return scene;
}

} // namespace

TEST_CASE("FNV-1a as written here starts and goes on as published") {
    // Three zero floats are 12 zero bytes, each a multiplication by the prime.
    std::vector<Vector3<float>> zero{Vector3<float>::Zero()};
    std::uint64_t expected = 0xcbf29ce484222325u;
    for (int k = 0; k < 12; ++k) expected *= 0x100000001b3u;
    CHECK(fnv<float>({&zero}) == expected);
}

TEMPLATE_TEST_CASE("the hash is FNV-1a of theta and theta_dot", "", float, double) {
    const Tree tree = make_tree::branched();
    const auto plan = plan_of<TestType>(tree, empty_scene());
    State<TestType> state = make_state(plan);
    shake(plan, state, 3, 1, 2);
    const std::uint64_t hash = state_hash(state);
    CHECK(hash == fnv<TestType>({&state.theta, &state.theta_dot}));
    state.theta_dot[7].y() = std::nextafter(state.theta_dot[7].y(), TestType(9)); // one bit
    CHECK(state_hash(state) != hash);
}

TEST_CASE("a new state stands at the plan's start, at rest, at step 0") {
    const Tree tree = make_tree::chain(6, 2, 0.05, 0.01, 0.1);
    Scene scene;
    scene.pose = Pose::settled;
    const auto plan = plan_of(tree, scene);
    const State<double> state = make_state(plan);
    CHECK(state.step == 0);
    CHECK(plan.theta_start[5].norm() > 1e-9);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK(state.theta[i] == plan.theta_start[i]);
        CHECK(state.theta_dot[i] == Vec3::Zero());
        CHECK(parts::scaled_rate(state)[i] == Vec3::Zero());
        CHECK((state.R_wb[i] * state.R_wb[i].transpose() - Mat3::Identity()).norm() < 1e-13);
    }
}

TEMPLATE_TEST_CASE("the number of threads does not change a bit", "", float, double) {
    const Tree tree = make_tree::random_tree(5000, 1);
    const auto plan = plan_of<TestType>(tree, gusty());
    std::uint64_t one_thread = 0;
    for (int threads : {1, 2, 3, 8, 15}) {
        const ThreadLimit limit(threads);
        State<TestType> state = make_state(plan);
        for (int k = 0; k < 10; ++k) advance(plan, state);
        if (threads == 1) {
            one_thread = state_hash(state);
            CHECK_FALSE(first_non_finite(state).has_value());
            CHECK(state.theta_dot[2500].norm() > 0);
        }
        CAPTURE(threads);
        CHECK(state_hash(state) == one_thread);
    }
}

TEMPLATE_TEST_CASE("nor does it with the coupled solver, whatever the scheme's poles", "", float, double) {
    const Tree tree = make_tree::forest(std::vector<Tree>(10, make_tree::random_tree(300, 2)));
    for (const Scheme scheme : {Scheme::p12, Scheme::p34, Scheme::lie}) {
        const auto plan = make_plan<TestType>(tree, {{0, tree.size_bodies(), 0}}, stiff_gusty(), {}, 1.0 / 30,
                                              Solver::coupled, scheme);
        std::uint64_t one_thread = 0;
        for (int threads : {1, 2, 8, 15}) {
            const ThreadLimit limit(threads);
            State<TestType> state = make_state(plan);
            for (int k = 0; k < 5; ++k) advance(plan, state);
            if (threads == 1) {
                one_thread = state_hash(state);
                CHECK_FALSE(first_non_finite(state).has_value());
                CHECK(state.theta_dot[150].norm() > 0);
            }
            CAPTURE(scheme_of(scheme).name, threads);
            CHECK(state_hash(state) == one_thread);
        }
    }
}

TEMPLATE_TEST_CASE("a run cut in two goes on as if it had not been", "", float, double) {
    const Tree tree = make_tree::random_tree(300, 2);
    const auto plan = plan_of<TestType>(tree, gusty());
    State<TestType> whole = make_state(plan);
    for (int k = 0; k < 10; ++k) advance(plan, whole);

    State<TestType> resumed = make_state(plan);
    resumed.theta = whole.theta;
    resumed.theta_dot = whole.theta_dot;
    parts::scaled_rate(resumed) = parts::scaled_rate(whole);
    resumed.step = whole.step;
    state_update(plan, resumed);
    for (int k = 0; k < 10; ++k) {
        advance(plan, whole);
        advance(plan, resumed);
        CAPTURE(k);
        CHECK(state_hash(whole) == state_hash(resumed));
    }
    CHECK(resumed.step == 20);
}

TEMPLATE_TEST_CASE("a coupled run cut in two goes on by its last changes, with every scheme", "", float, double) {
    const Tree tree = make_tree::random_tree(300, 2);
    Scene scene = stiff_gusty();
    const Quat turned(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
    scene.root_motion.push_back(
        {0, {0, 0.3, 0.9}, {Vec3::Zero(), Vec3(0.2, 0.1, 0), Vec3(-0.1, 0, 0.3)}, {Quat::Identity(), turned, turned}});
    for (const Scheme scheme : all_schemes) {
        CAPTURE(scheme_of(scheme).name);
        const auto plan =
            make_plan<TestType>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, Solver::coupled, scheme);
        State<TestType> whole = make_state(plan), resumed = make_state(plan);
        for (int k = 0; k < 10; ++k) advance(plan, whole);
        REQUIRE_FALSE(first_non_finite(whole).has_value());
        CHECK(parts::scaled_rate(whole).capacity() == 0);
        resumed.theta = whole.theta;
        resumed.theta_dot = whole.theta_dot;
        parts::theta_change(resumed) = parts::theta_change(whole);
        parts::theta_dot_change(resumed) = parts::theta_dot_change(whole);
        resumed.step = whole.step;
        move_ground(plan, resumed, double(resumed.step) * plan.dt);
        state_update(plan, resumed);
        State<TestType> forgetful = resumed;
        for (Vector3<TestType>& change : parts::theta_change(forgetful)) change.setZero();
        for (int k = 0; k < 10; ++k) {
            advance(plan, whole);
            advance(plan, resumed);
            advance(plan, forgetful);
            CAPTURE(k);
            CHECK(state_hash(whole) == state_hash(resumed));
        }
        // Without the changes it is another motion, but with the scheme that does not extrapolate.
        CHECK((state_hash(whole) == state_hash(forgetful)) == !scheme_of(scheme).extrapolates);
    }
}

TEST_CASE("the first body that is not finite is found") {
    const Tree tree = make_tree::branched();
    const auto plan = plan_of(tree, empty_scene());
    State<double> state = make_state(plan);
    CHECK_FALSE(first_non_finite(state).has_value());
    state.theta_dot[9].z() = std::numeric_limits<double>::infinity();
    CHECK(first_non_finite(state) == 9);
    state.theta[4].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(first_non_finite(state) == 4);
}
