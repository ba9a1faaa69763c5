// What lies on the trees: areas from above, and the sag it makes against closed forms; the start balances.
#include "lib/model/static_load.h"
#include "formats/documents/tree.h"
#include "lib/growth/segment.h"
#include "lib/model/append.h"
#include "lib/plan/pose.h"
#include "lib/study/solvers.h"
#include "tests/support/inverse_dynamics.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace simulate;

namespace {

using std::numbers::pi;
constexpr double g = 9.81;

// One rod whose axis leans from the vertical by `lean` towards +x.
Tree rod(double lean, double youngs = 9e9) {
    make_tree::Wood wood;
    wood.youngs = youngs;
    Tree tree = make_tree::chain(1, 1, 0.02, 0.01, 0, wood);
    tree.joint_rotation[0] = (make_tree::turn(-lean, Vec3::UnitZ()) * tree.joint_rotation[0]).normalized();
    return tree;
}

Tree loaded(Tree tree, const StaticLoad& load) {
    lay_load(tree, load);
    return tree;
}

double height(const StartPose& pose) { // of the rod's direction, above the horizontal [rad]
    const Quat q = pose.joint_rotation[0] * quaternion_from_vector<double>(pose.theta[0]);
    return std::asin((q * Vec3::UnitZ()).y());
}

} // namespace

TEST_CASE("bodies carry what they show from above") {
    const StaticLoad load{2, 3, 5, 7};
    for (const double lean : {0.0, 0.3, pi / 2, 2.0}) {
        const Tree tree = loaded(rod(lean), load), bare = rod(lean);
        const double shown = 2 * 0.015 * 1 * std::abs(std::sin(lean)); // 2 r l sin
        CHECK(tree.load[0] == Approx(2 * shown).margin(1e-15));
        CHECK(tree.mass[0] - bare.mass[0] == Approx(tree.load[0]).margin(1e-12));
        CHECK((tree.inertia[0] / tree.mass[0] - bare.inertia[0] / bare.mass[0]).norm() < 1e-15);
        CHECK(tree.com[0] == bare.com[0]);
    }
    // A leaf and a petal that lie flat but for a tilt about their length, and a fruit, on an upright stem.
    Tree tree = rod(0);
    const Quat flat =
        make_tree::turn(-pi / 2, Vec3::UnitX()); // z of the stem's frame, which is up, becomes the leaf's y
    for (const double tilt : {0.0, 0.7})
        make_tree::add_leaf(tree, 0, {0, 0, 1}, make_tree::turn(tilt, Vec3::UnitY()) * flat, 0.1, 0.06, 3e-4, 0, 0, 1);
    tree.kind[2] = Kind::petal;
    make_tree::add_fruit(tree, 0, {0, 0, 1}, make_tree::turn(2, Vec3(1, 2, 3)), 0.05, 0.04, 0, 0, 1);
    const LoadLaid laid = lay_load(tree, load);
    CHECK(tree.load[0] < 1e-15);
    CHECK(tree.load[1] == Approx(3 * 0.003));
    CHECK(tree.load[2] == Approx(5 * 0.003 * std::cos(0.7)));
    CHECK(tree.load[3] == Approx(7 * pi * 0.0016));
    CHECK(laid.mass == Approx(tree.load[1] + tree.load[2] + tree.load[3]));
}

TEST_CASE("a clump carries what its leaves show from above, however it stands") {
    const double area = 0.3 * 0.2 / 2;
    for (const double facing : {0.0, 0.4, 1.0})
        for (const double turned : {0.0, 0.8, pi / 2}) {
            Tree tree = rod(0);
            make_tree::add_leaf(tree, 0, {0, 0, 1}, make_tree::turn(turned, Vec3::UnitX()), 0.3, 0.2, 3e-3, 0, 0, 1);
            tree.leaf_count = {1, 14};
            tree.leaf_facing = {0, facing};
            lay_load(tree, {2, 3, 5, 7});
            // A share of them faces up, the others all ways: half of their area shows.
            CHECK(tree.load[1] == Approx(3 * area * (facing + (1 - facing) * 0.5)).epsilon(1e-12));
        }
}

TEST_CASE("a rod on one joint sinks under snow to the balance of its moments, from the pose it was drawn in") {
    const double snow = 40;
    for (const double lean : {pi / 2, 1.0}) {
        const Tree bare = rod(lean, 2e8), tree = loaded(bare, {snow, 0, 0, 0});
        const double K = bare.stiffness[0].x(), c = bare.com[0].z(), m = bare.mass[0], M = tree.mass[0];
        const double drawn = pi / 2 - lean; // above the horizontal
        // The spring carries m g c cos(drawn) there; turned down by d it gives K d more, against M g c cos(drawn - d).
        double low = 0, high = 2;
        for (int k = 0; k < 200; ++k) {
            const double d = (low + high) / 2;
            const double left = m * g * c * std::cos(drawn) + K * d - M * g * c * std::cos(drawn - d);
            (left < 0 ? low : high) = d;
        }
        REQUIRE(low > 0.02);
        const StartPose pose = start_pose(tree, Vec3(0, -g, 0), Pose::drawn);
        CHECK(height(pose) == Approx(drawn - low).margin(1e-12));
        CHECK(height(start_pose(bare, Vec3(0, -g, 0), Pose::drawn)) == Approx(drawn).margin(1e-14));
        // Settled: all of it from the unloaded spring. Rest: where it was drawn.
        low = 0, high = 2;
        for (int k = 0; k < 200; ++k) {
            const double d = (low + high) / 2;
            (K * d < M * g * c * std::cos(drawn - d) ? low : high) = d;
        }
        CHECK(height(start_pose(tree, Vec3(0, -g, 0), Pose::settled)) == Approx(drawn - low).margin(1e-12));
        CHECK(height(start_pose(tree, Vec3(0, -g, 0), Pose::rest)) == Approx(drawn).margin(1e-14));
    }
}

TEST_CASE("snow on a cantilever sags it by w l^4 / 8 E I, its own weight left out, to second order in the pieces") {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {Vec3(0, 1, 0), Vec3(2, 1, 0)};
    s.radius = {0.02, 0.02};
    Material wood = wood_presets().front();
    wood.youngs_modulus = 1e13; // so stiff that the sag is small and linear
    const double snow = 25, w = snow * 2 * 0.02 * g, I = pi * std::pow(0.02, 4) / 4;
    const double beam = w * 16 / (8 * wood.youngs_modulus * I);
    double error[3];
    for (int k = 0; k < 3; ++k) {
        SegmentOptions options;
        options.segment_length = 2.0 / (5 << k);
        Tree tree = segment(s, wood, options);
        lay_load(tree, {snow, 0, 0, 0});
        PlainRun<double> run(tree, Scene());
        const std::size_t tip = tree.size_bodies() - 1;
        const Vec3 end = run.state.x_w[tip] + run.state.R_wb[tip].col(2) * tree.size[tip][0];
        error[k] = std::abs((1 - end.y()) / beam - 1);
    }
    CHECK(error[0] < 0.05);
    CHECK(error[0] / error[1] == Approx(4).epsilon(0.05));
    CHECK(error[1] / error[2] == Approx(4).epsilon(0.05));
}

TEST_CASE("the start under snow is in balance: nothing moves, with either solver, and in lanes") {
    for (const Pose pose : {Pose::drawn, Pose::settled}) {
        Tree tree = make_tree::branched();
        for (std::size_t i = 10; i < 14; ++i) tree.stiffness[i] *= 100; // leaves and fruit, that hold it
        const LoadLaid laid = lay_load(tree, {20, 1, 1, 5});
        REQUIRE(laid.bodies == 14);
        Scene scene;
        scene.pose = pose;
        for (const Solver solver : {Solver::coupled, Solver::analytic})
            for (const bool lanes : {false, true}) {
                const Plan<double> plan =
                    make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, solver, Scheme::p12,
                                      lanes ? std::optional<fast::Target>(fast::Target::baseline) : std::nullopt);
                CHECK(plan.stepper->in_lanes() == lanes);
                State<double> state = make_state(plan);
                const auto x = state.x_w;
                const auto R = state.R_wb;
                double moved = 0;
                for (int k = 0; k < 60; ++k) advance(plan, state);
                present(plan, state);
                for (std::size_t i = 0; i < plan.bodies; ++i)
                    moved = std::max({moved, (state.x_w[i] - x[i]).norm(), (state.R_wb[i] - R[i]).norm()});
                CHECK(moved < 1e-10);
                if (lanes) continue;
                const std::vector<Vec3> none(plan.bodies, Vec3::Zero());
                CHECK(inverse_dynamics(plan, plan.theta_start, none, none, 0).relative() < 1e-12);
            }
    }
}

TEST_CASE("soft twigs with large wet leaves find the balance from the drawn pose") {
    Tree tree = read_tree(Input(BOUGH_DATA_DIR "/scenes/trees/maple_leaves.safetensors"));
    lay_load(tree, {10, 0.1, 0, 0});
    const Plan<double> plan =
        make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, Scene(), {}, 1.0 / 30, Solver::coupled);
    const std::vector<Vec3> none(plan.bodies, Vec3::Zero());
    CHECK(inverse_dynamics(plan, plan.theta_start, none, none, 0).relative() < 1e-11);
}

TEST_CASE("a tree finds its sag by itself, whatever stands beside it, and one that finds none is named") {
    Tree soft = make_tree::branched(), stiff = make_tree::branched();
    for (std::size_t i = 0; i < stiff.size_bodies(); ++i) stiff.stiffness[i] *= 200, soft.stiffness[i] *= 100;
    for (Tree* tree : {&soft, &stiff}) lay_load(*tree, {20, 1, 1, 5});
    Tree both = soft;
    append(both, stiff, Vec3(3, 0, 0), 0);
    const Vec3 down(0, -g, 0);
    for (const Pose pose : {Pose::drawn, Pose::settled}) {
        const StartPose whole = start_pose(both, down, pose);
        const std::size_t first = soft.size_bodies();
        const StartPose a = start_pose(soft, down, pose), b = start_pose(stiff, down, pose);
        for (std::size_t i = 0; i < both.size_bodies(); ++i) {
            CHECK(whole.theta[i] == (i < first ? a.theta[i] : b.theta[i - first]));
            const Quat& rest = i < first ? a.joint_rotation[i] : b.joint_rotation[i - first];
            CHECK(whole.joint_rotation[i].coeffs() == rest.coeffs());
        }
    }
    Tree falls = both;
    for (std::size_t i = soft.size_bodies(); i < falls.size_bodies(); ++i) falls.stiffness[i] *= 1e-6;
    try {
        start_pose(falls, down, Pose::settled);
        FAIL("the second tree cannot stand");
    } catch (const std::domain_error& error) {
        const std::string text = error.what();
        REQUIRE(text.substr(0, 5) == "body ");
        CHECK(std::stoul(text.substr(5)) >= soft.size_bodies());
    }
}

TEST_CASE("a stem that buckles under its load goes over to where it stands in balance") {
    const double length = 1, r = 0.004;
    make_tree::Wood wood;
    wood.shear = 9e9; // stiff in torsion, so that what has gone over does not roll over sideways
    wood.damping = 0.1;
    Tree tree = make_tree::chain(6, length, r, r, 0.01, wood);
    make_tree::add_fruit(tree, 5, {0, 0, length / 6}, Quat::Identity(), 0.01, 0.04, 0, 0, 1);
    tree.stiffness[6].setConstant(10);
    for (int k = 0; k < 6; ++k)
        tree.stiffness[std::size_t(k)].y() *= 2; // flat: where it goes over to is no matter of chance
    const double critical =
        pi * pi * 9e9 * (pi * std::pow(r, 4) / 4) / (4 * length * length) / g; // [kg] Euler's, clamped below
    const LoadLaid laid = lay_load(tree, {0, 0, 0, 110});
    REQUIRE(tree.mass[6] - laid.mass < 0.6 * critical);
    REQUIRE(tree.mass[6] > 1.5 * critical);
    const Plan<double> plan = make_plan<double>(tree, {{0, 7, 0}}, Scene(), {}, 1.0 / 30, Solver::coupled);
    const std::vector<Vec3> none(plan.bodies, Vec3::Zero());
    CHECK(inverse_dynamics(plan, plan.theta_start, none, none, 0).relative() < 1e-11);
    State<double> state = make_state(plan);
    const auto x = state.x_w;
    CHECK(x[6].y() < 0.8 * length);        // far over
    state.theta[0] += Vec3(0.02, 0.02, 0); // stable: back after a push
    restart(plan, state);
    for (int k = 0; k < 3000; ++k) advance(plan, state);
    CHECK((state.x_w[6] - x[6]).norm() < 1e-6);
}

TEST_CASE("the springs of a drawn tree under snow are those of the tree without, and no snow changes nothing") {
    const Tree bare = make_tree::branched();
    Tree tree = bare, clear = bare;
    lay_load(tree, {20, 0, 0, 0});
    const LoadLaid nothing = lay_load(clear, {});
    CHECK(nothing.bodies == 0);
    const Vec3 gravity(0, -g, 0);
    const StartPose with = start_pose(tree, gravity, Pose::drawn), without = start_pose(bare, gravity, Pose::drawn),
                    none = start_pose(clear, gravity, Pose::drawn);
    double sunk = 0;
    for (std::size_t i = 0; i < bare.size_bodies(); ++i) {
        CHECK((with.joint_rotation[i].coeffs() - without.joint_rotation[i].coeffs()).norm() < 1e-12);
        CHECK((none.theta[i] - without.theta[i]).norm() < 1e-14);
        sunk = std::max(sunk, (with.theta[i] - without.theta[i]).norm());
    }
    CHECK(sunk > 1e-4);
}
