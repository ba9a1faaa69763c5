// Rest of the coupled step: poses that gravity holds stay, and where it comes to rest all moments balance, by
// inverse_dynamics.h (no elimination, no linearisation, no step).
#include "lib/plan/pose.h"
#include "tests/support/coupled_support.h"
#include "tests/support/inverse_dynamics.h"

using namespace bough;
using namespace coupled;

namespace {

Tree leafy_and_stiff() {
    Tree tree = leafy(2e9, 0.01);
    for (std::size_t i = 21; i < tree.size_bodies(); ++i)
        tree.stiffness[i] *= 100; // on which the leaves and fruit stand
    return tree;
}

double largest(const std::vector<Vec3>& v) {
    double most = 0;
    for (const Vec3& x : v) most = std::max(most, x.norm());
    return most;
}

double imbalance(const CoupledRun<double>& run) {
    const std::vector<Vec3> none(run.plan.bodies, Vec3::Zero());
    const double time = double(run.state.step) * run.plan.dt;
    return inverse_dynamics(run.plan, run.state.theta, none, none, time).relative();
}

} // namespace

TEST_CASE("the drawn pose and the settled pose stay where they are, a thousand frames, with every scheme") {
    for (const Pose pose : {Pose::drawn, Pose::settled})
        for (const Tree& tree : {paper_trees::chain(2e9, 0.01), paper_trees::branched(2e8, 0.01), leafy_and_stiff()})
            for (const Scheme scheme : all_schemes) {
                Scene scene;
                scene.pose = pose;
                CoupledRun<double> run(tree, scene, scheme);
                const auto R = run.state.R_wb;
                const auto x = run.state.x_w;
                REQUIRE(largest(run.state.theta) > 1e-3);
                run.steps(1000);
                double moved = 0;
                for (std::size_t i = 0; i < run.plan.bodies; ++i)
                    moved = std::max({moved, (run.state.R_wb[i] - R[i]).norm(), (run.state.x_w[i] - x[i]).norm()});
                CAPTURE(pose, tree.name, scheme_of(scheme).name);
                CHECK(moved < 1e-9);
            }
}

TEST_CASE("in a steady wind the tree comes to rest where wind, weight and springs balance") {
    Tree tree = paper_trees::branched(2e8, 0.05);
    make_tree::add_leaf(tree, 15, {0, 0, 0.1}, make_tree::turn(0.4, Vec3(1, 0.3, 0.2)), 0.08, 0.05, 3e-4, 1, 1, 1);
    make_tree::add_fruit(tree, 10, {0, 0, 0.12}, make_tree::turn(2.5, Vec3::UnitY()), 0.06, 0.03, 1, 1, 1);
    Scene scene;
    scene.wind = Wind();
    scene.wind->velocity = Vec3(6, 0.5, 2); // with its profile over height
    for (const Scheme scheme : {Scheme::p12, Scheme::p34, Scheme::lie}) {
        CoupledRun<double> run(tree, scene, scheme);
        CHECK(imbalance(run) > 1e-2);
        run.steps(3000);
        CAPTURE(scheme_of(scheme).name);
        CHECK(largest(run.state.theta_dot) < 1e-12);
        CHECK(imbalance(run) < 1e-12);
    }
}

TEST_CASE("so it does on a steadily accelerated ground, and on one that turns steadily") {
    Scene scene;
    scene.pose = Pose::rest;
    scene.root_motion = {two_keys()};
    for (const bool turns : {false, true}) {
        const double T = 1000;
        const Vec3 a = turns ? Vec3::Zero() : Vec3(3, 1, -2), omega = turns ? Vec3(0, 1.5, 0) : Vec3::Zero();
        RootSpline ground;
        ground.position = QuinticSpline{{0, T}, {Vec3::Zero(), a * T * T / 2}, {Vec3::Zero(), a * T}, {a, a}};
        ground.rotation =
            QuinticSpline{{0, T}, {Vec3::Zero(), omega * T}, {omega, omega}, {Vec3::Zero(), Vec3::Zero()}};
        Tree tree = paper_trees::branched(2e8, 0.05);
        tree.joint_position[0] = Vec3(0.7, 0.2, -0.4);
        CoupledRun<double> run(tree, scene);
        run.plan.splines = {ground};
        run.steps(2000);
        CAPTURE(turns);
        CHECK(largest(run.state.theta) > 1e-2);
        CHECK(largest(run.state.theta_dot) < 1e-9);
        CHECK(imbalance(run) < 1e-9);
        if (turns) continue;
        // Gravity tilted the other way, in statics exactly: the settled pose, which no step has found.
        const StartPose settled = start_pose(tree, scene.gravity - a, Pose::settled);
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            CHECK((run.state.theta[i] - settled.theta[i]).norm() < 1e-9);
    }
}
