// Frozen coefficients: made anew at every change they are the full update; the plain path and the lanes keep and make anew the same ones; what
// changes a composite is noticed, whatever it is; equilibria are the true ones; and the bits do not depend on threads or a cut.
#include "lanes_support.h"
#include "lib/stages/composite.h"
#include "lib/stages/external_forces.h"
#include "lib/stages/frozen.h"
#include "lib/stages/joint.h"
#include "lib/stages/state_update.h"
#include <Eigen/Cholesky>
#ifdef _OPENMP
#include <omp.h>
#endif

using namespace bough;
using namespace lanes;

namespace {

constexpr double at_any_change = 1e-300;

std::vector<Case> cases(double refresh) {
    const Tree large = firm(grown(600)), leafy = coupled::leafy(1e9, 0.01);
    std::vector<Case> all;
    Scene drop;
    drop.pose = Pose::rest;
    all.push_back({"rest pose let go", large, drop});
    all.push_back({"gusts, leaves and fruit", large, in_wind(gusts())});
    Scene pulled = in_wind(gusts());
    pulled.pulls = pulls();
    all.push_back({"pulls in gusts", leafy, pulled});
    all.push_back({"no gravity", large, solver::empty_scene(), 0.005, 0.1});
    Scene still = solver::empty_scene();
    still.wind = Wind{};
    all.push_back({"still air, no gravity", leafy, still, 0.05});
    Scene only_pulled = solver::empty_scene();
    only_pulled.pulls = pulls();
    all.push_back({"pulls, no gravity", leafy, only_pulled});
    all.push_back({"large angles", make_tree::chain(6, 3, 0.03, 0.02), slack(), 1.2, 0.1});
    all.push_back({"several blocks", firm(grown(3000)), in_wind(gusts())});
    for (Case& c : all) {
        c.solver = Solver::analytic;
        c.refresh = refresh;
    }
    return all;
}

template <class T> std::uint64_t kept_joints(const Run<T>& run) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < run.plan.bodies; ++i) number += keeps_coefficients(run.plan, i);
    return number;
}

Simd in_lanes() {
    return fast::best_target();
}

// A post of 1 m with two opposite arms of 2 m at its top.
Tree cross() {
    Tree tree = make_tree::chain(1, 1, 0.05, 0.05);
    for (const int side : {1, -1})
        make_tree::add_piece(tree, 0, Vec3(0, 0, 1), make_tree::turn(side * std::numbers::pi / 2, Vec3(1, 0, 0)), 2,
                             0.05, 0.05, side > 0 ? 1 : 2, 1, 1);
    return tree;
}

} // namespace

TEST_CASE("coefficients made anew at any change are the full update") {
    for (const Simd simd : {Simd(), in_lanes()})
        for (Case& c : cases(0)) {
            Run<> full(c, simd);
            c.refresh = at_any_change;
            Run<> anew(c, simd);
            REQUIRE(anew.plan.refresh == at_any_change);
            const std::vector<Vec3> start = full.state.theta;
            const Apart d = run_apart(full, anew, 40);
            CAPTURE(c.name, simd.has_value());
            REQUIRE(most(start, full.state.theta) > 1e-3);
            REQUIRE(anew.state.flags.refreshed > 30 * kept_joints(anew));
            CHECK(d.theta < 1e-10);
            CHECK(d.theta_dot < 1e-9);
        }
}

TEST_CASE("lanes keep and make anew what the plain path does") {
    for (const double refresh : {0.02, 0.1})
        for (const Case& c : cases(refresh)) {
            Run<> plain(c, std::nullopt), lanes(c, in_lanes());
            REQUIRE(lanes.plan.lanes.on);
            const Apart d = run_apart(plain, lanes, 60);
            CAPTURE(c.name, refresh);
            CHECK(d.theta < 1e-11);
            CHECK(d.theta_dot < 1e-10);
            CHECK(lanes.state.flags.refreshed == plain.state.flags.refreshed);
            CHECK(plain.state.flags.refreshed >= kept_joints(plain));     // all of them once
            CHECK(plain.state.flags.refreshed < 30 * kept_joints(plain)); // half of all
            CHECK(lanes.state.flags.energy_guard == plain.state.flags.energy_guard);
            CHECK(lanes.state.flags.buckling == plain.state.flags.buckling);
            CHECK(plain.calls(Stage::refresh) == 60);
            CHECK(plain.calls(Stage::drag) == 0);
            CHECK(lanes.calls(Stage::refresh) == 0);
        }
}

TEST_CASE("whatever changes a composite by more than the tolerance is noticed, and nothing below it") {
    const auto post_was_made_anew = [](const std::vector<Vec3>& turn, double share) {
        Case c{"cross", cross(), solver::empty_scene()};
        c.solver = Solver::analytic;
        c.refresh = 0.1;
        Run<> run(c, std::nullopt);
        run.steps(1);
        REQUIRE(run.state.flags.refreshed == 3);
        const FrozenJoint<double> post = run.state.frozen[0];
        for (std::size_t i = 0; i < turn.size(); ++i) run.state.theta[i] = share * turn[i];
        state_update(run.plan, run.state);
        run.steps(1);
        return !std::equal(post.J, post.J + 6, run.state.frozen[0].J);
    };
    const Vec3 still = Vec3::Zero();
    for (const auto& [share, noticed] : {std::pair(1.0, true), std::pair(0.02, false)}) {
        CAPTURE(share);
        // Both arms folded up: the first moment's direction stays.
        CHECK(post_was_made_anew({still, Vec3(-0.4, 0, 0), Vec3(0.4, 0, 0)}, share) == noticed);
        // The post bends, arms and all.
        CHECK(post_was_made_anew({Vec3(0, 0.4, 0), still, still}, share) == noticed);
        // It twists: first moment and trace stay.
        CHECK(post_was_made_anew({Vec3(0, 0, 0.4), still, still}, share) == noticed);
    }
}

TEST_CASE("a wind that rises makes twigs anew, one that hardly changes does not; leaves keep nothing") {
    Scene scene = in_wind(Wind{});
    scene.wind->velocity = Vec3(6, 0, 0);
    Case c{"", firm(grown(600)), scene};
    c.solver = Solver::analytic;
    c.refresh = 0.1;
    const auto made_anew = [&c](double speed) { // share of the branches' joints
        Run<> run(c, std::nullopt);
        run.steps(2);
        const std::vector<FrozenJoint<double>> before = run.state.frozen;
        run.plan.scene.wind->velocity = Vec3(speed, 0, 0);
        run.steps(1);
        double made = 0;
        for (std::size_t i = 0; i < c.tree.size_bodies(); ++i) {
            if (c.tree.kind[i] != Kind::branch) CHECK(run.state.frozen[i].wind == 0);
            made += run.state.frozen[i].wind != before[i].wind;
        }
        return made / double(kept_joints(run));
    };
    CHECK(made_anew(30) > 0.5); // leaves fold: it takes more wind
    CHECK(made_anew(6.05) < 0.1);
}

TEST_CASE("with kept coefficients a loaded tree comes to rest where it would without") {
    Scene scene;
    scene.pulls = {coupled::pull_on(3, Vec3(1, 0, -4), Vec3(1, 0, -4))};
    scene.pulls[0].time = {0, 1e6};
    scene.wind = Wind{};
    scene.wind->velocity = Vec3(3, 0, 1); // steady: drags to rest
    Case c{"", coupled::leafy(1e9, 0.05), scene};
    c.solver = Solver::analytic;
    Run<> full(c, std::nullopt);
    c.refresh = 0.3;
    Run<> kept(c, in_lanes());
    full.steps(6000), kept.steps(6000);
    present(kept.plan, kept.state);
    REQUIRE(most(full.plan.theta_start, full.state.theta) > 1e-2);
    REQUIRE(most(full.state.theta_dot, std::vector<Vec3>(c.tree.size_bodies(), Vec3::Zero())) < 1e-9);
    CHECK(most(full.state.theta, kept.state.theta) < 1e-9);
}

TEST_CASE("all targets keep the same to rounding") {
    for (const Case& c : cases(0.1))
        if (c.tree.size_bodies() <= 1000) check_targets_agree(c, 1e-4);
}

TEMPLATE_TEST_CASE("a run with kept coefficients cut in two goes on as if it had not been", "", float, double) {
    using T = TestType;
    for (const Simd simd : {Simd(), in_lanes()})
        for (const Case& c : cases(0.05)) {
            Run<T> whole(c, simd);
            whole.steps(7);
            const std::uint64_t cut = whole.hash();
            const std::vector<double> saved = saved_frozen(whole.plan, whole.state);
            Case calm = c; // a fresh state, not shaken
            calm.angle = calm.rate = 0;
            Run<T> resumed(calm, simd), forgetful(calm, simd);
            for (Run<T>* run : {&resumed, &forgetful}) {
                run->state.step = whole.state.step;
                run->state.theta = whole.state.theta;
                run->state.theta_dot = whole.state.theta_dot;
                run->state.scaled_rate = whole.state.scaled_rate;
                restart(run->plan, run->state);
            }
            restore_frozen(resumed.plan, resumed.state, saved);
            CAPTURE(c.name, simd.has_value());
            CHECK(resumed.hash() == cut);
            whole.steps(20), resumed.steps(20), forgetful.steps(20);
            CHECK(resumed.hash() == whole.hash());
            CHECK(forgetful.hash() != whole.hash()); // so they are state
        }
}

TEST_CASE("a state started again between two steps goes on as it was, whether poses are kept or not") {
    Case c{"", firm(grown(600)), in_wind(gusts())};
    c.solver = Solver::analytic;
    c.refresh = 0.05;
    for (const Simd simd : {Simd(), in_lanes()})
        for (const bool pose : {true, false}) {
            Wishes wishes;
            wishes.pose = pose;
            Run<> whole(c, simd, Scheme::p12, wishes), again(c, simd, Scheme::p12, wishes);
            whole.steps(20);
            again.steps(10);
            present(again.plan, again.state);
            restart(again.plan, again.state);
            again.steps(10);
            CAPTURE(simd.has_value(), pose);
            CHECK(whole.hash() == again.hash());
        }
}

// The rates of a start are L^T times the joints': the first step's air meets the bodies as fast as they are.
TEST_CASE("a tree that starts on the move in wind takes its first step as the full update does") {
    Case c{"", firm(grown(600)), in_wind(gusts())};
    c.solver = Solver::analytic;
    Run<> full(c, std::nullopt);
    c.refresh = 0.05;
    Run<> plain(c, std::nullopt), lanes(c, in_lanes());
    make_tree::Dice dice{std::mt19937(3)};
    external_forces(full.plan, full.state, 0);
    composite_update(full.plan, full.state);
    for (std::size_t i = 0; i < full.plan.bodies; ++i) {
        const Vec3 rate = solver::random_vector(dice, 0.5);
        const Mat3 L = joint_inertia(full.plan, full.state, i).llt().matrixL();
        for (Run<>* run : {&full, &plain, &lanes}) {
            run->state.theta_dot[i] = rate;
            run->state.scaled_rate[i] = L.transpose() * body_rate_jacobian(run->state.theta[i]) * rate;
        }
    }
    for (Run<>* run : {&full, &plain, &lanes}) {
        restart(run->plan, run->state);
        run->frame();
    }
    CHECK(most(full.state.theta, full.plan.theta_start) > 1e-3);
    CHECK(most(full.state.theta, plain.state.theta) < 1e-12);
    CHECK(most(full.state.theta, lanes.state.theta) < 1e-12);
}

TEST_CASE("what is no save of this plan's coefficients is refused") {
    Case c{"", coupled::leafy(1e9, 0.01), in_wind(gusts())};
    c.solver = Solver::analytic;
    c.refresh = 0.1;
    Run<> run(c, in_lanes());
    run.steps(3);
    const std::vector<double> good = saved_frozen(run.plan, run.state);
    CHECK_NOTHROW(restore_frozen(run.plan, run.state, good));
    std::vector<double> wrong = good;
    wrong.pop_back();
    CHECK_THROWS_AS(restore_frozen(run.plan, run.state, wrong), std::invalid_argument);
    wrong = good;
    wrong[5] = NAN;
    CHECK_THROWS_AS(restore_frozen(run.plan, run.state, wrong), std::invalid_argument);
    wrong = good;
    for (double& value : wrong) value = -value;
    CHECK_THROWS_AS(restore_frozen(run.plan, run.state, wrong), std::invalid_argument);
    c.refresh = 0;
    Run<> full(c, in_lanes());
    CHECK(saved_frozen(full.plan, full.state).empty());
    CHECK_THROWS_AS(restore_frozen(full.plan, full.state, good), std::invalid_argument);
}

TEST_CASE("coefficients are kept where they can be, and elsewhere the reason is said") {
    Case c{"", coupled::leafy(1e9, 0.01), in_wind(gusts())};
    c.solver = Solver::analytic;
    c.refresh = 0.1;
    const auto left_out = [&](const std::string& reason) {
        const Run<> run(c, in_lanes());
        CAPTURE(reason);
        CHECK(run.plan.refresh == 0);
        CHECK(run.plan.refresh_reason == reason);
        CHECK(run.state.frozen.capacity() == 0);
        CHECK(run.state.lanes.frozen.empty());
    };
    Run<> plain(c, std::nullopt), lanes(c, in_lanes());
    CHECK(plain.state.frozen.size() == c.tree.size_bodies());
    CHECK(lanes.state.frozen.capacity() == 0);
    CHECK(lanes.state.lanes.frozen.size() > 0);
    c.refresh = 0;
    left_out("not asked for");
    c.refresh = 0.1;
    c.scene.joint_limit = JointLimit{};
    left_out("/joint_limit");
    c.scene.joint_limit.reset();
    c.scene.root_motion = {carried_about()};
    left_out("/root_motion");
    c.solver = Solver::coupled;
    left_out("solver coupled");
}

#ifdef _OPENMP
TEMPLATE_TEST_CASE("the number of threads does not change a bit of what is kept", "", float, double) {
    const int threads_before = omp_get_max_threads();
    Case c{"", firm(grown(3000)), in_wind(gusts())};
    c.solver = Solver::analytic;
    c.refresh = 0.02;
    for (const Simd simd : {Simd(), in_lanes()}) {
        std::uint64_t one = 0, made = 0;
        for (const int threads : {1, 2, 3, 8, 15}) {
            omp_set_num_threads(threads);
            Run<TestType> run(c, simd);
            run.steps(20);
            if (threads == 1) {
                one = run.hash();
                made = run.state.flags.refreshed;
            }
            CHECK(run.hash() == one);
            CHECK(run.state.flags.refreshed == made);
        }
    }
    omp_set_num_threads(threads_before);
}
#endif
