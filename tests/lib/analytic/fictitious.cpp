// The lagged terms (20): accelerations against differences, torques against sums over bodies, a chain against the articulated reference.
#include "lib/analytic/fictitious.h"
#include "lib/analytic/composite.h"
#include "lib/lanes/target.h"
#include "lib/plan/ground.h"
#include "lib/study/solvers.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <array>
#include <catch2/catch.hpp>

using namespace bough;
using namespace simulate;

namespace {

Scene lagged(double acceleration, double turning, double gyroscopic) {
    Scene scene;
    scene.gravity.setZero();
    scene.pose = Pose::rest;
    scene.joint_inertia = JointInertia::paper;
    scene.fictitious = Fictitious{acceleration, turning, gyroscopic};
    return scene;
}

RootMotion swung() {
    RootMotion m;
    m.time = {0, 0.5, 1};
    m.position = {Vec3::Zero(), Vec3(0.5, 0.2, -0.3), Vec3(0.1, 0, 0)};
    m.rotation = {Quat::Identity(), make_tree::turn(0.8, Vec3(0.3, 1, 0)), make_tree::turn(1.5, Vec3(0.3, 1, 0.4))};
    return m;
}

// In the midst of the ground's motion, the joints as shaken or at rest, accelerations up to date.
PlainRun<double> shaken(const Tree& tree, const Scene& scene, double rate) {
    PlainRun<double> run(tree, scene, 1e-5);
    make_tree::Dice dice{std::mt19937(7)};
    run.state.step = 45000;
    for (Vec3& spin : parts::joints(run.state).spin_dot) spin = solver::random_vector(dice, 10 * rate);
    move_ground(run.plan, run.state, 0.45);
    solver::shake(run.plan, run.state, 5, 0.4, rate);
    accelerations(run.plan, run.state, parts::joints(run.state));
    parts::composite_update(run.plan, run.state);
    return run;
}

} // namespace

TEST_CASE("accelerations are the derivatives of the velocities, of every body, on a moving ground") {
    const Tree tree = make_tree::branched();
    const std::size_t n = tree.size_bodies();
    Scene scene = lagged(1, 0, 0);
    scene.root_motion = {swung()};
    PlainRun<double> run(tree, scene, 1e-5, {true, false});
    make_tree::Dice dice{std::mt19937(3)};
    std::vector<std::array<Vec3, 3>> path; // theta(t) = p0 + p1 t + p2 t^2 / 2 about 0.3 s
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 p0 = solver::random_vector(dice, 0.4), p1 = solver::random_vector(dice, 3);
        path.push_back({p0, p1, solver::random_vector(dice, 20)});
    }
    const auto theta = [&](std::size_t i, double t) {
        return Vec3(path[i][0] + t * path[i][1] + t * t / 2 * path[i][2]);
    };
    const auto rate = [&](std::size_t i, double t) { // J theta_dot
        return Vec3(body_rate_jacobian<double>(theta(i, t)) * (path[i][1] + t * path[i][2]));
    };
    const double h = 1e-5;
    const auto at = [&](double t) {
        for (std::size_t i = 0; i < n; ++i) {
            run.state.theta[i] = theta(i, t);
            run.state.theta_dot[i] = path[i][1] + t * path[i][2];
            parts::joints(run.state).spin_dot[i] = (rate(i, t + h) - rate(i, t - h)) / (2 * h);
        }
        move_ground(run.plan, run.state, 0.3 + t);
        state_update(run.plan, run.state);
        accelerations(run.plan, run.state, parts::joints(run.state));
        return run.state;
    };
    const State<double> before = at(-h), after = at(h), now = at(0);
    const auto of_joint = [&](const State<double>& s, std::size_t i) {
        return Vec3(s.v_w[i] - s.omega_w[i].cross(Vec3(s.R_wb[i] * tree.com[i])));
    };
    for (std::size_t i = 0; i < n; ++i) {
        CAPTURE(i);
        const Vec3 alpha = (after.omega_w[i] - before.omega_w[i]) / (2 * h),
                   a = (of_joint(after, i) - of_joint(before, i)) / (2 * h);
        REQUIRE(alpha.norm() > 1);
        REQUIRE(a.norm() > 0.1);
        CHECK((parts::joints(now).alpha_w[i] - alpha).norm() < 1e-6 * alpha.norm());
        CHECK((parts::joints(now).a_w[i] - a).norm() < 1e-6 * a.norm());
    }
}

TEST_CASE("a joint's own acceleration is that of its rate at the step's end") {
    make_tree::Wood wood;
    wood.damping = 1e-4;
    const Tree tree =
        make_tree::chain(1, 1, 0.02, 0.015, 0, wood); // its inertia about the joint stays, in its own axes
    const double dt = 2e-5;
    PlainRun<double> run(tree, lagged(1, 1, 0), dt); // of a root on a ground at rest these are nothing
    run.state.theta[0] = Vec3(0.2, -0.1, 0.05);
    restart(run.plan, run.state);
    const auto rate = [&] { return Vec3(body_rate_jacobian(run.state.theta[0]) * run.state.theta_dot[0]); };
    double most = 0, worst = 0;
    for (int k = 0; k < 400; ++k) {
        run.steps(1);
        const Vec3 before = rate();
        run.steps(1);
        const Vec3 found = parts::joints(run.state).spin_dot[0];
        run.steps(1);
        const Vec3 truth = (rate() - before) / (2 * dt);
        most = std::max(most, truth.norm());
        worst = std::max(worst, (found - truth).norm());
    }
    CHECK(most > 1000);
    CHECK(worst < 2e-3 * most);
}

TEST_CASE("the terms are what carrying the bodies with the joint takes, body by body, less the ground's share") {
    const Tree tree = make_tree::branched();
    Scene scene = lagged(1, 1, 1);
    scene.root_motion = {swung()};
    PlainRun<double> run = shaken(tree, scene, 2);
    parts::fictitious_torques(run.plan, run.state);
    const State<double>& s = run.state;
    const Ground g = ground_at(run.plan.splines[0], 0.45);
    for (std::size_t j = 0; j < tree.size_bodies(); ++j) {
        const bool root = tree.parent[j] < 0;
        const auto p = std::size_t(tree.parent[j]);
        const Vec3 omega_p = root ? g.omega : s.omega_w[p], omega = s.omega_w[j];
        const Vec3 alpha =
            (root ? g.alpha : parts::joints(s).alpha_w[p]) + omega_p.cross(omega); // (19) without its own spring's part
        Vec3 truth = Vec3::Zero();
        for (std::size_t b = j; b < tree.size_bodies(); ++b) {
            std::int64_t up = std::int64_t(b);
            while (up > std::int64_t(j)) up = tree.parent[std::size_t(up)];
            if (up != std::int64_t(j)) continue;
            const Mat3& R = s.R_wb[b];
            const Vec3 x = s.x_w[b] + R * tree.com[b], r = x - s.x_w[j], arm = x - g.x;
            const Mat3 I = R * tree.inertia[b] * R.transpose();
            const Vec3 carried = parts::joints(s).a_w[j] + alpha.cross(r) + omega.cross(omega.cross(r));
            const Vec3 ground = g.a + g.alpha.cross(arm) + g.omega.cross(g.omega.cross(arm));
            truth -= r.cross(tree.mass[b] * (carried - ground)) + I * (alpha - g.alpha);
            truth -= omega.cross(I * omega) - g.omega.cross(I * g.omega);
        }
        CAPTURE(j);
        CHECK((parts::joints(s).fictitious_w[j] - truth).norm() < 1e-9 * (truth.norm() + 1e-6));
    }
    // One multiplier a term.
    const std::vector<Vec3> all = parts::joints(s).fictitious_w;
    std::vector<Vec3> sum(all.size(), Vec3::Zero());
    for (const Fictitious& one : {Fictitious{1, 0, 0}, Fictitious{0, 1, 0}, Fictitious{0, 0, 1}}) {
        run.plan.scene.fictitious = one;
        parts::fictitious_torques(run.plan, run.state);
        double most = 0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += parts::joints(run.state).fictitious_w[i];
            most = std::max(most, parts::joints(run.state).fictitious_w[i].norm());
        }
        CHECK(most > 1e-3);
    }
    for (std::size_t i = 0; i < sum.size(); ++i) CHECK((sum[i] - all[i]).norm() < 1e-12 * (1 + all[i].norm()));
}

TEST_CASE("a ground's own motion is not counted twice: carried rigidly, the terms are nothing") {
    Scene scene = lagged(1, 1, 1);
    scene.root_motion = {swung()};
    PlainRun<double> run = shaken(make_tree::branched(), scene, 0);
    parts::fictitious_torques(run.plan, run.state);
    REQUIRE(parts::joints(run.state).alpha_w[5].norm() > 1);
    REQUIRE(parts::joints(run.state).a_w[5].norm() > 1);
    for (const Vec3& tau : parts::joints(run.state).fictitious_w) CHECK(tau.norm() < 1e-12);
}

TEST_CASE("a twig on a swaying stem follows the articulated reference with the terms, and not without") {
    // Each piece is light beside what carries it: (20) has what the stem does to the twig and leaves out what that does back, which
    // is little then.
    for (const int joints : {2, 3}) {
        Tree tree;
        const double lengths[] = {1, 1, 0.5}, radii[] = {0.05, 0.002, 0.0005}, youngs[] = {1e8, 2.4e10, 4.8e11};
        for (int k = 0; k < joints; ++k) {
            make_tree::Wood wood;
            wood.youngs = youngs[k];
            wood.shear = wood.youngs / 2;
            wood.damping = 0.004;
            make_tree::add_piece(tree, k - 1, k == 0 ? Vec3::Zero() : Vec3(0, 0, lengths[k - 1]),
                                 k == 0 ? make_tree::upright() : make_tree::turn(0.6, Vec3(1, 0.4, 0)), lengths[k],
                                 radii[k], radii[k], k, k, 0, wood);
        }
        Scene scene = lagged(1, 1, 1);
        const double seconds = 1;
        const auto track = [&](Solver solver, double dt, double multiplier) {
            Scene with = scene;
            with.fictitious = Fictitious{multiplier, multiplier, multiplier};
            with = for_solver(with, solver);
            Plan<double> plan = make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, with, {}, dt, solver);
            parts::set_tolerance(plan, 1e-10);
            State<double> state = make_state(plan);
            state.theta[0] = Vec3(0.2, 0.1, 0);
            restart(plan, state);
            std::vector<Vec3> out;
            for (int f = 1; f <= int(seconds / 0.01 + 0.5); ++f) {
                for (int k = 0; k < int(0.01 / dt + 0.5); ++k) advance(plan, state);
                out.push_back(state.theta[tree.size_bodies() - 1]);
            }
            return out;
        };
        const auto truth = track(Solver::articulated_reference, 0.01, 0);
        const auto off = [&](const std::vector<Vec3>& found) {
            double sum = 0, all = 0;
            for (std::size_t k = 0; k < truth.size(); ++k) {
                sum += (found[k] - truth[k]).squaredNorm();
                all += truth[k].squaredNorm();
            }
            return std::sqrt(sum / all);
        };
        const double with = off(track(Solver::analytic, 1e-4, 1)), without = off(track(Solver::analytic, 1e-4, 0));
        CAPTURE(joints, with, without);
        CHECK(without > 0.9);
        CHECK(with < 0.2);
    }
}

TEST_CASE("the terms are for the analytic solver, on the plain path; all 0 is none") {
    const Tree tree = make_tree::branched();
    const std::vector<TreeRange> ranges{{0, tree.size_bodies(), 0}};
    const Scene scene = lagged(0.5, 0, 0.25);
    for (const Solver solver : all_solvers)
        if (solver != Solver::analytic)
            CHECK_THROWS_WITH(make_plan<double>(tree, ranges, scene, {}, 0.01, solver),
                              Catch::StartsWith("fictitious: only for solver analytic; solver " +
                                                std::string(solver_name(solver)) + " has these terms by nature"));
    const auto plan_of = [&](const Scene& s) {
        return make_plan<float>(tree, ranges, s, {}, 0.01, Solver::analytic, Scheme::p12, fast::Target::baseline);
    };
    const Plan<float> plan = plan_of(scene);
    CHECK(parts::joints(plan).fictitious);
    CHECK_FALSE(plan.stepper->in_lanes());
    CHECK(plan.stepper->kind().plainly == "/fictitious");
    const Plan<float> none = plan_of(lagged(0, 0, 0));
    CHECK_FALSE(parts::joints(none).fictitious);
    CHECK(none.stepper->in_lanes());
    Scene plain = lagged(0, 0, 0), absent = plain;
    absent.fictitious.reset();
    PlainRun<double> a(tree, plain), b(tree, absent), c(tree, scene);
    for (PlainRun<double>* run : {&a, &b, &c}) {
        run->state.theta[0] = Vec3(0.1, 0, 0.05);
        restart(run->plan, run->state);
        run->steps(30);
    }
    CHECK(state_hash(a.state) == state_hash(b.state));
    CHECK(state_hash(a.state) != state_hash(c.state));
}

TEST_CASE("a run with the terms that is cut and gone on with is the run in one") {
    const Tree tree = make_tree::branched();
    Scene scene = lagged(0.3, 0.3, 0.3);
    scene.gravity = Vec3(0, -9.81, 0);
    scene.root_motion = {swung()};
    PlainRun<double> whole(tree, scene), first(tree, scene), second(tree, scene);
    whole.steps(30);
    first.steps(13);
    second.state.theta = first.state.theta;
    second.state.theta_dot = first.state.theta_dot;
    parts::scaled_rate(second.state) = parts::scaled_rate(first.state);
    parts::joints(second.state).spin_dot = parts::joints(first.state).spin_dot;
    second.state.step = 13;
    restart(second.plan, second.state);
    second.steps(17);
    CHECK(state_hash(second.state) == state_hash(whole.state));
    CHECK(whole.largest_angle() > 1e-3);
}
