// The coupled step in SIMD lanes against the plain one, which is other code with its sums in another order: in double equal to rounding,
// in float as near to double as the plain one is; its targets against each other; what it refuses.
#include "lib/study/step_bytes.h"
#include "tests/support/lanes_support.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace lanes;

namespace {

std::vector<Case> cases() {
    const Tree large = firm(grown(600)), leafy = coupled::leafy(1e9, 0.01);
    std::vector<Case> all = first_cases(large, leafy);
    Scene pulled;
    pulled.pulls = pulls(20);
    all.push_back({"pulls", large, pulled});
    pulled.pulls = pulls();
    pulled.wind = gusts();
    all.push_back({"pulls in gusts", leafy, pulled});
    Scene moved;
    moved.root_motion = {shifted()};
    all.push_back({"ground that moves", leafy, moved});
    moved.root_motion = {carried_about()};
    all.push_back({"ground that moves and turns", leafy, moved});
    all.push_back({"everything", large, everything()});
    Case forest{"three trees, one on a ground that moves", {}, everything()};
    forest.tree = three_trees(forest.ranges);
    forest.scene.root_motion = {shifted(1)};
    all.push_back(forest);
    all.push_back({"no gravity", large, solver::empty_scene(), 0.005, 0.1});
    Scene still = solver::empty_scene();
    still.wind = Wind{};
    all.push_back({"still air, no gravity", large, still, 0.02, 0.3});
    all.push_back({"still air", leafy, in_wind(Wind{}), 0.05, 0.5});
    all.push_back({"large turns", make_tree::chain(6, 3, 0.03, 0.02), slack(), 1.2, 0.1});
    all.push_back({"several blocks", firm(grown(3000)), in_wind(gusts())});
    return all;
}

} // namespace

TEST_CASE("in double, lanes and the plain step are the same to rounding") {
    constexpr int frames = 60;
    for (const Case& c : cases())
        for (const Scheme scheme : {Scheme::p12, Scheme::p25, Scheme::p50, Scheme::p34}) {
            if (scheme != Scheme::p12 && c.tree.size_bodies() > 1000) continue;
            LanesRun<> plain(c, std::nullopt, scheme), lanes(c, fast::best_target(), scheme);
            CAPTURE(c.name, scheme_of(scheme).name);
            REQUIRE(lanes.plan.stepper->in_lanes());
            const std::vector<Vec3> start = plain.state.theta;
            const Apart d = run_apart(plain, lanes, frames);
            const double turned = most(start, plain.state.theta);
            REQUIRE(turned > 1e-3);
            // Where the energy guard acts, its factor is a root of a difference of energies, and may keep half of the digits alone.
            const bool guarded = scheme == Scheme::p34 && plain.state.flags.energy_guard > 0;
            CHECK(d.theta < (guarded ? 1e-9 : 1e-11));
            CHECK(d.theta_dot < (guarded ? 1e-7 : 1e-10));
            CHECK(d.x < 1e-11);
            CHECK(lanes.state.flags.fast_turns == plain.state.flags.fast_turns);
            CHECK(lanes.state.flags.half_turns == plain.state.flags.half_turns);
            CHECK(lanes.state.flags.energy_guard == plain.state.flags.energy_guard);
            CHECK(lanes.state.step == frames);
            // It was the lanes that stepped.
            CHECK(lanes.calls(Stage::lanes) == frames);
            CHECK(lanes.calls(Stage::resolvent) == 0);
            CHECK(lanes.calls(Stage::midpoint) == 0);
            CHECK(plain.calls(Stage::lanes) == 0);
            CHECK(plain.calls(Stage::resolvent) == frames);
        }
}

TEST_CASE("velocities and torques that were asked for are the plain step's") {
    Case c{"", firm(grown(600)), everything()};
    LanesRun<> plain(c, std::nullopt, Scheme::p12, {true, true}),
        lanes(c, fast::best_target(), Scheme::p12, {true, true});
    for (int k = 0; k < 30; ++k) {
        plain.frame();
        lanes.frame();
        double K = 0;
        for (const Vec3& stiffness : plain.plan.K) K = std::max(K, stiffness.maxCoeff());
        CHECK(most(plain.state.v_w, lanes.state.v_w) < 1e-10);
        CHECK(most(plain.state.omega_w, lanes.state.omega_w) < 1e-10);
        CHECK(most(plain.state.torque_j, lanes.state.torque_j) < 1e-10 * K);
        double turned = 0;
        for (std::size_t i = 0; i < plain.plan.bodies; ++i)
            turned = std::max(turned, (plain.state.R_wb[i] - lanes.state.R_wb[i]).norm());
        CHECK(turned < 1e-11);
    }
}

TEST_CASE("all targets come to the same") {
    for (const Case& c : cases())
        if (c.tree.size_bodies() <= 1000) check_targets_agree(c, 1e-5); // measured: 2e-6
}

TEST_CASE("AVX2 and AVX-512 give the same bits") {
    if (!both_wide()) {
        WARN("AVX2 and AVX-512 are not compared: this build or this machine has one of them at most");
        return;
    }
    for (const Case& c : cases())
        if (c.tree.size_bodies() <= 1000) check_same_bits(c);
}

TEST_CASE("what is too much for the caches and goes past them comes back the same") {
    if (sanitized) return; // many bodies; and the sanitizers' builds have no target that does
    const Case c{"", firm(grown(90000)), in_wind(gusts())};
    REQUIRE_FALSE(
        fast::streams(parts::lanes(LanesRun<>({"small", grown(20000), {}}, fast::best_target()).plan).layout));
    for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
        LanesRun<> plain(c, std::nullopt, scheme), lanes(c, fast::best_target(), scheme);
        REQUIRE(fast::streams(parts::lanes(lanes.plan).layout));
        const Apart d = run_apart(plain, lanes, 3);
        CHECK(d.theta < 1e-11);
        CHECK(d.theta_dot < 1e-9);
        if (!both_wide()) continue; // AVX-512 alone writes whole lines past them
        LanesRun<> narrow(c, Target::avx2, scheme), wide(c, Target::avx512, scheme);
        narrow.steps(3);
        wide.steps(3);
        CHECK(narrow.hash() == wide.hash());
    }
}

TEST_CASE("float lanes stay as near to double as the plain step's float does") {
    for (const Case& c : cases())
        if (c.tree.size_bodies() <= 1000) check_float_drift(c, 300);
}

TEST_CASE("what lanes do not hold is refused with its reason and steps on the plain path") {
    Case c{"", coupled::leafy(1e9, 0.01), in_wind(gusts())};
    const auto refused = [&](Solver solver, Scheme scheme, const std::string& reason) {
        LanesRun<> asked(c, fast::best_target(), scheme, {}, solver), plain(c, std::nullopt, scheme, {}, solver);
        CAPTURE(reason);
        CHECK_FALSE(asked.plan.stepper->in_lanes());
        CHECK(asked.plan.stepper->kind().plainly == reason);
        const PlannedStage stage = explain(asked.plan).stages[std::size_t(Stage::lanes)];
        CHECK_FALSE(stage.on);
        CHECK(stage.reason.find(reason) != std::string::npos);
        CHECK(parts::lanes(asked.plan).constants.empty());
        CHECK(parts::lanes(asked.state).table.empty());
        for (int k = 0; k < 5; ++k) {
            asked.frame();
            plain.frame();
            CHECK(state_hash(asked.state) == state_hash(plain.state));
        }
        CHECK(asked.calls(Stage::lanes) == 0);
    };
    refused(Solver::coupled, Scheme::lie, "scheme LIE");
    refused(Solver::articulated_implicit, Scheme::p12, "solver articulated-implicit");
    c.scene.joint_limit = JointLimit{};
    refused(Solver::coupled, Scheme::p12, "/joint_limit");

    c.scene.joint_limit.reset();
    CHECK(LanesRun<>(c, fast::best_target()).plan.stepper->kind().plainly.empty());
    CHECK(LanesRun<>(c, std::nullopt).plan.stepper->kind().plainly == "not asked for");
}

// Bodies on joints of no stiffness, each spinning about an axis of its own: theta = w t, taken the shorter way round.
TEMPLATE_TEST_CASE("half turns of free bodies are those of a rigid body", "", float, double) {
    using T = TestType;
    constexpr int frames = 100;
    const std::vector<Vec3> spin{{2.5, 0, 0}, {0, 2.5, 0}, {0, 0, 2.5}, {0, -1.9, 0}, {0.1, 2.4, 0.3}, {1, 1, 2}};
    Case c{"free bodies", {}, solver::empty_scene()};
    std::vector<Tree> bodies;
    for (std::size_t k = 0; k < spin.size(); ++k) {
        bodies.push_back(make_tree::chain(1, 0.5, 0.03, 0.02));
        bodies.back().stiffness[0].setZero();
        bodies.back().joint_rotation[0] = Quat::Identity(); // what a spin about y leaves of x is zero exactly
        c.ranges.push_back({k, 1, std::int32_t(k)});
    }
    c.tree = make_tree::forest(bodies);
    LanesRun<T> plain(c, std::nullopt), lanes(c, fast::best_target());
    for (LanesRun<T>* run : {&plain, &lanes}) {
        for (std::size_t k = 0; k < spin.size(); ++k) run->state.theta_dot[k] = spin[k].cast<T>();
        restart(run->plan, run->state);
    }
    std::uint64_t expected = 0;
    for (std::size_t k = 0; k < 4; ++k)
        expected += std::uint64_t(std::floor((spin[k].norm() * frames / 30 / std::numbers::pi + 1) / 2));
    double off = 0;
    for (int f = 1; f <= frames; ++f) {
        plain.frame();
        lanes.frame();
        for (std::size_t k = 0; k < 4; ++k) { // about a principal axis
            const Mat3 truth = make_tree::turn(spin[k].norm() * f / 30, spin[k]).toRotationMatrix();
            off = std::max(off, (truth - lanes.state.R_wb[k].template cast<double>()).norm());
        }
    }
    const double apart = most(plain.state.theta, lanes.state.theta);
    CHECK(off < (sizeof(T) == 4 ? 1e-4 : 1e-11));
    CHECK(apart < (sizeof(T) == 4 ? 1e-3 : 1e-11));
    CHECK(plain.state.flags.half_turns > expected); // and the tumbling ones
    CHECK(lanes.calls(Stage::resolvent) == 0);
}

// A spin about y or z leaves theta's x at zero exactly.
TEMPLATE_TEST_CASE("half turns are counted about whatever axis they are", "", float, double) {
    for (const Vec3& spin : {Vec3(2.5, 0, 0), Vec3(0, 2.5, 0), Vec3(0, 0, 2.5)}) {
        Case c{"free body", make_tree::chain(1, 0.5, 0.03, 0.02), solver::empty_scene()};
        c.tree.stiffness[0].setZero();
        c.tree.joint_rotation[0] = Quat::Identity();
        LanesRun<TestType> lanes(c, fast::best_target());
        lanes.state.theta_dot[0] = spin.cast<TestType>();
        restart(lanes.plan, lanes.state);
        lanes.steps(120); // 10 rad: past pi and 3 pi
        CAPTURE(spin.transpose());
        CHECK(lanes.state.flags.half_turns == 2);
    }
}
