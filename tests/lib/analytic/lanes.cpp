// The analytic step in SIMD lanes against the plain one, which is other code in other axes with its sums in another order: in double
// equal to rounding, in float as near to double as the plain one is, every guard as often; its targets against each other; what it refuses.
#include "lib/base/oscillator.h"
#include "tests/support/lanes_support.h"
#include "tests/support/solver_parts.h"

using namespace bough;
using namespace lanes;

namespace {

template <class T = double> struct AnalyticRun : LanesRun<T> {
    AnalyticRun(const Case& c, Simd simd, const Wishes& wishes = {})
        : LanesRun<T>(c, simd, Scheme::p12, wishes, Solver::analytic) {}
};

Scene pulled(Scene scene, double times = 1) {
    scene.pulls = pulls(times);
    return scene;
}

Scene of_paper(Scene scene) {
    scene.joint_inertia = JointInertia::paper;
    return scene;
}

std::vector<Case> cases() {
    const Tree large = firm(grown(600)), leafy = coupled::leafy(1e9, 0.01);
    std::vector<Case> all = first_cases(large, leafy);
    all.push_back({"gusts, the paper's inertia", leafy, of_paper(in_wind(gusts()))});
    all.push_back({"pulls", large, pulled({}, 20)});
    all.push_back({"pulls in gusts", large, pulled(in_wind(gusts()))});
    Case forest{"three trees", {}, pulled(in_wind(gusts()))};
    forest.tree = three_trees(forest.ranges);
    all.push_back(forest);
    all.push_back({"no gravity", large, solver::empty_scene(), 0.005, 0.1});
    all.push_back({"pulls, no gravity", large, pulled(solver::empty_scene(), 20)});
    Scene still = solver::empty_scene();
    still.wind = Wind{};
    all.push_back({"still air, no gravity", large, still, 0.02, 0.3});
    all.push_back({"still air", leafy, in_wind(Wind{}), 0.05, 0.5});
    all.push_back({"large angles", make_tree::chain(6, 3, 0.03, 0.02), slack(), 1.2, 0.1});
    Tree three = leafy; // three-valued K, and bodies with inertias of no symmetry
    make_tree::Dice dice{std::mt19937(2)};
    for (std::size_t i = 0; i < three.size_bodies(); ++i) {
        for (int k = 0; k < 3; ++k) three.stiffness[i][k] *= dice(0.5, 2);
        const Mat3 R = make_tree::turn(dice(-1, 1), Vec3(dice(-1, 1), 1, dice(-1, 1))).toRotationMatrix();
        three.inertia[i] = R * three.inertia[i] * R.transpose();
        three.com[i] += Vec3(dice(-1, 1), dice(-1, 1), 0) * 0.1 * three.com[i].norm();
    }
    all.push_back({"three-valued K, skew bodies", three, pulled(in_wind(gusts()))});
    all.push_back({"several blocks", firm(grown(3000)), in_wind(gusts())});
    for (Case& c : all) c.solver = Solver::analytic;
    return all;
}

} // namespace

TEST_CASE("in double, analytic lanes and the plain step are the same to rounding") {
    constexpr int frames = 60;
    for (const Case& c : cases()) {
        AnalyticRun<> plain(c, std::nullopt), lanes(c, fast::best_target());
        CAPTURE(c.name);
        REQUIRE(lanes.plan.stepper->in_lanes());
        const std::vector<Vec3> start = plain.state.theta;
        const Apart d = run_apart(plain, lanes, frames);
        REQUIRE(most(start, plain.state.theta) > 1e-3);
        CHECK(d.theta < 1e-11);
        CHECK(d.theta_dot < 1e-9); // of leaves, which weigh a tenth of a gram
        CHECK(d.x < 1e-11);
        CHECK(most(parts::scaled_rate(plain.state), parts::scaled_rate(lanes.state)) < 1e-11);
        CHECK(lanes.state.flags.buckling == plain.state.flags.buckling);
        CHECK(lanes.state.flags.bounded_lambda == plain.state.flags.bounded_lambda);
        CHECK(lanes.state.flags.half_turns == plain.state.flags.half_turns);
        CHECK(lanes.state.flags.energy_guard == plain.state.flags.energy_guard);
        CHECK(lanes.state.step == frames);
        // It was the lanes that stepped.
        CHECK(lanes.calls(Stage::lanes) == frames);
        CHECK(lanes.calls(Stage::spring) == 0);
        CHECK(plain.calls(Stage::lanes) == 0);
        CHECK(plain.calls(Stage::spring) == frames);
    }
}

TEST_CASE("velocities and torques that were asked for are the plain analytic step's") {
    const Case c{"", firm(grown(600)), pulled(in_wind(gusts()))};
    AnalyticRun<> plain(c, std::nullopt, {true, true}), lanes(c, fast::best_target(), {true, true});
    double K = 0;
    for (const Vec3& stiffness : plain.plan.K) K = std::max(K, stiffness.maxCoeff());
    for (int k = 0; k < 30; ++k) {
        plain.frame();
        lanes.frame();
        CHECK(most(plain.state.v_w, lanes.state.v_w) < 1e-10);
        CHECK(most(plain.state.omega_w, lanes.state.omega_w) < 1e-10);
        CHECK(most(plain.state.torque_j, lanes.state.torque_j) < 1e-10 * K);
    }
}

TEST_CASE("analytic lanes come to the same on all targets") {
    for (const Case& c : cases())
        if (c.tree.size_bodies() <= 1000) check_targets_agree(c, 1e-4);
}

// Wood too soft for its weight and for the wind, thrown about: each guard has work.
TEST_CASE("analytic lanes buckle, turn over and are guarded as often as the plain step") {
    Scene heavy, windy = in_wind(gusts());
    heavy.pose = windy.pose = Pose::rest;
    heavy.stiffness_scale = 1e-4;
    windy.stiffness_scale = 1e-3;
    for (const Case& c : {Case{"weight", grown(600), heavy, 0.3, 30}, Case{"gusts", grown(600), windy, 0.3, 10}}) {
        AnalyticRun<> plain(c, std::nullopt), lanes(c, fast::best_target());
        const Apart d = run_apart(plain, lanes, 6);
        const StepFlags &p = plain.state.flags, &l = lanes.state.flags;
        CAPTURE(c.name);
        REQUIRE(p.buckling > 100);
        REQUIRE(p.half_turns > 10);
        REQUIRE(p.energy_guard > 4);
        CHECK(l.buckling == p.buckling);
        CHECK(l.half_turns == p.half_turns);
        CHECK(l.energy_guard == p.energy_guard);
        CHECK(d.theta < 1e-11);
    }
}

TEST_CASE("what is too stiff for a number is bounded in lanes as often as on the plain path") {
    Case c{"rod", make_tree::chain(1, 1, 0.02, 0.02), solver::empty_scene(), 1e-4, 1e-3};
    c.scene.joint_inertia = JointInertia::paper;
    const Plan<double> plan = AnalyticRun<>(c, std::nullopt).plan;
    const double lambda = plan.K[0].minCoeff() / plan.inertia_joint[0].diagonal().maxCoeff();
    for (const double stiffest : {1e18, 1e25, 1e33}) {
        c.scene.stiffness_scale = stiffest / lambda;
        AnalyticRun<float> plain(c, std::nullopt), lanes(c, fast::best_target());
        plain.steps(10), lanes.steps(10);
        CAPTURE(stiffest);
        CHECK(plain.state.flags.bounded_lambda == 30);
        CHECK(lanes.state.flags.bounded_lambda == 30);
        present(lanes.plan, lanes.state);
        REQUIRE_FALSE(first_non_finite(lanes.state).has_value());
        CHECK(lanes.state.theta[0].norm() < 3e-4);
    }
}

TEST_CASE("float analytic lanes stay as near to double as the plain step's float does") {
    for (const Case& c : cases())
        if (c.tree.size_bodies() <= 1000) check_float_drift(c, 300);
}

TEST_CASE("what analytic lanes do not hold is refused with its reason and steps on the plain path") {
    Case c{"", coupled::leafy(1e9, 0.01), in_wind(gusts())};
    const auto refused = [&](const std::string& reason) {
        AnalyticRun<> asked(c, fast::best_target()), plain(c, std::nullopt);
        CAPTURE(reason);
        CHECK_FALSE(asked.plan.stepper->in_lanes());
        CHECK(asked.plan.stepper->kind().plainly == reason);
        CHECK(explain(asked.plan).stages[std::size_t(Stage::lanes)].reason == "plain path: " + reason);
        CHECK(parts::lanes(asked.state).now.empty());
        asked.steps(5), plain.steps(5);
        CHECK(state_hash(asked.state) == state_hash(plain.state));
        CHECK(asked.calls(Stage::lanes) == 0);
    };
    c.scene.joint_limit = JointLimit{};
    refused("/joint_limit");
    c.scene.joint_limit.reset();
    c.scene.root_motion = {carried_about()};
    refused("/root_motion");
    c.scene.root_motion.clear();
    c.scene.fictitious = Fictitious{0.1, 0, 0};
    refused("/fictitious");
}

// Bodies on joints of no stiffness, each spinning about an axis of its own: theta = w t, taken the shorter way round.
TEMPLATE_TEST_CASE("a free body spins in analytic lanes as a rigid body does", "", float, double) {
    using T = TestType;
    constexpr int frames = 100;
    for (const Vec3& spin : {Vec3(2.5, 0, 0), Vec3(0, 2.5, 0), Vec3(0, 0, 2.5), Vec3(0, -1.9, 0)}) {
        Case c{"free body", make_tree::chain(1, 0.5, 0.03, 0.02), solver::empty_scene()};
        c.tree.stiffness[0].setZero();
        c.tree.joint_rotation[0] = Quat::Identity();
        c.scene.joint_inertia = JointInertia::paper;
        AnalyticRun<T> lanes(c, fast::best_target());
        lanes.state.theta_dot[0] = spin.cast<T>();
        // L^T w, and the inertia about a principal axis: one of the three stays
        Matrix3<T> S = lanes.plan.inertia_joint[0];
        S.diagonal().array() += 4 * std::numeric_limits<T>::epsilon() * S.trace(); // joint.h
        const Matrix3<T> L = S.llt().matrixL();
        parts::scaled_rate(lanes.state)[0] = L.transpose() * lanes.state.theta_dot[0];
        restart(lanes.plan, lanes.state);
        double off = 0;
        for (int f = 1; f <= frames; ++f) {
            lanes.frame();
            const Mat3 truth = make_tree::turn(spin.norm() * f / 30, spin).toRotationMatrix();
            off = std::max(off, (truth - lanes.state.R_wb[0].template cast<double>()).norm());
        }
        CAPTURE(spin.transpose());
        CHECK(off < (sizeof(T) == 4 ? 1e-4 : 1e-11));
        CHECK(lanes.state.flags.half_turns ==
              std::uint64_t(std::floor((spin.norm() * frames / 30 / std::numbers::pi + 1) / 2)));
    }
}

// One joint, one step: the rod's pendulum in closed form, theta'' + beta K/J theta' + K/J theta = 0 about a principal axis.
TEMPLATE_TEST_CASE("one joint in analytic lanes rings by its closed form", "", float, double) {
    using T = TestType;
    for (const int axis : {0, 2}) {
        Case c{"rod", make_tree::chain(1, 1, 0.02, 0.02), solver::empty_scene()};
        c.tree.joint_rotation[0] = Quat::Identity();
        c.scene.joint_inertia = JointInertia::paper;
        // 20 rad/s, damped by a twentieth of what is critical
        const Plan<double> plan = AnalyticRun<>(c, std::nullopt).plan;
        const Mat3& own = plan.inertia_joint[0];
        const double J = own(axis, axis) + 4 * double(std::numeric_limits<T>::epsilon()) * own.trace(); // joint.h
        const double rate = 20, half = rate / 20;
        c.scene.stiffness_scale = rate * rate * J / plan.K[0][axis];
        c.tree.damping[0] = 2 * half / (rate * rate);
        AnalyticRun<T> lanes(c, fast::best_target());
        const double h = lanes.plan.dt;
        const double start = 0.01;
        lanes.state.theta[0].setZero();
        lanes.state.theta[0][axis] = T(start);
        restart(lanes.plan, lanes.state);
        const double ring = std::sqrt(rate * rate - half * half);
        double off = 0;
        for (int f = 1; f <= 40; ++f) {
            lanes.frame();
            const double t = f * h;
            const double truth = start * std::exp(-half * t) * (std::cos(ring * t) + half / ring * std::sin(ring * t));
            off = std::max(off, std::abs(truth - double(lanes.state.theta[0][axis])));
        }
        CAPTURE(axis);
        CHECK(off < start * (sizeof(T) == 4 ? 1e-3 : 1e-11));
    }
}
