#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace simulate;

namespace {

using std::numbers::pi;

// A horizontal chain of n rods along +x; gravity bends it in the x-y plane.
Tree level_chain(int n, double youngs) {
    make_tree::Wood wood;
    wood.youngs = youngs;
    wood.damping = 0.05;
    Tree tree = make_tree::chain(n, 2, 0.02, 0.012, 0, wood);
    tree.joint_rotation[0] = make_tree::turn(-pi / 2, Vec3::UnitZ()) * tree.joint_rotation[0];
    return tree;
}

// Discrete statics of a planar chain, by itself: angles a_k of the rods from the horizontal, from
// K_k (a_k - a_{k-1}) = -g sum_{i >= k} m_i (x_i - x_k), by Newton's method with a numerical Jacobian on dense matrices.
std::vector<double> planar_statics(const Tree& tree, double g) {
    const auto n = Eigen::Index(tree.size_bodies());
    const auto residual = [&](const Eigen::VectorXd& a) {
        Eigen::VectorXd joint(n), com(n), r(n);
        double x = 0;
        for (Eigen::Index k = 0; k < n; ++k) {
            joint[k] = x;
            com[k] = x + tree.com[std::size_t(k)].z() * std::cos(a[k]);
            x += tree.size[std::size_t(k)][0] * std::cos(a[k]);
        }
        for (Eigen::Index k = 0; k < n; ++k) {
            double moment = 0;
            for (Eigen::Index i = k; i < n; ++i) moment += tree.mass[std::size_t(i)] * g * (com[i] - joint[k]);
            r[k] = tree.stiffness[std::size_t(k)].x() * (a[k] - (k ? a[k - 1] : 0)) + moment;
        }
        return r;
    };
    Eigen::VectorXd a = Eigen::VectorXd::Zero(n);
    for (int iteration = 0; iteration < 60; ++iteration) {
        const Eigen::VectorXd r = residual(a);
        Eigen::MatrixXd J(n, n);
        for (Eigen::Index c = 0; c < n; ++c) {
            Eigen::VectorXd up = a, down = a;
            up[c] += 1e-6;
            down[c] -= 1e-6;
            J.col(c) = (residual(up) - residual(down)) / 2e-6;
        }
        a -= J.partialPivLu().solve(r);
    }
    return {a.data(), a.data() + n};
}

template <class T> std::vector<double> rod_angles(const State<T>& state) {
    std::vector<double> a;
    for (const auto& R : state.R_wb) a.push_back(std::asin(double(R(1, 2))));
    return a;
}

} // namespace

TEST_CASE("The sag that steps settle to is the exact discrete static solution") {
    const int n = GENERATE(1, 4, 15);
    CAPTURE(n);
    const Tree tree = level_chain(n, 4e8);
    const std::vector<double> truth = planar_statics(tree, 9.81);
    REQUIRE(std::abs(truth.back()) > 0.2); // far from linear
    Scene scene;
    scene.pose = Pose::rest;
    scene.damping_scale = 4;
    PlainRun<double> run(tree, scene);
    run.steps(6000);
    const std::vector<double> found = rod_angles(run.state);
    for (std::size_t k = 0; k < truth.size(); ++k) CHECK(found[k] == Approx(truth[k]).margin(1e-9));

    SECTION("and the settled pose starts there") {
        scene.pose = Pose::settled;
        PlainRun<double> settled(tree, scene);
        const std::vector<double> start = rod_angles(settled.state);
        for (std::size_t k = 0; k < truth.size(); ++k) CHECK(start[k] == Approx(truth[k]).margin(1e-9));
    }
}

TEST_CASE("The sag of a cantilever approaches w L^4 / 8 E I with the square of the number of pieces") {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {Vec3(0, 0, 0), Vec3(2, 0, 0)};
    s.radius = {0.02, 0.02};
    Material wood = wood_presets().front();
    wood.youngs_modulus = 1e13; // so stiff that the sag is small and linear
    const double I = pi * std::pow(0.02, 4) / 4, w = wood.density * pi * 0.0004 * 9.81;
    const double beam = w * 16 / (8 * wood.youngs_modulus * I);
    double error[3];
    for (int k = 0; k < 3; ++k) {
        SegmentOptions options;
        options.segment_length = 2.0 / (5 << k);
        const Tree tree = segment(s, wood, options);
        REQUIRE(tree.size_bodies() == std::size_t(5 << k));
        Scene scene;
        scene.pose = Pose::settled;
        PlainRun<double> run(tree, scene);
        const std::size_t tip = tree.size_bodies() - 1;
        const Vec3 end = run.state.x_w[tip] + run.state.R_wb[tip].col(2) * tree.size[tip][0];
        error[k] = std::abs(-end.y() / beam - 1);
    }
    CHECK(error[0] < 0.05);
    CHECK(error[0] / error[1] == Approx(4).epsilon(0.05));
    CHECK(error[1] / error[2] == Approx(4).epsilon(0.05));
}

TEST_CASE("The drawn pose stays where it was drawn") {
    const unsigned seed = GENERATE(1u, 2u, 3u);
    const Tree tree =
        segment(grow_bodies(default_growth(), seed, {true, false, true}, 800), wood_presets().front(), {});
    Scene scene;
    PlainRun<double> run(tree, scene);
    PlainRun<double> drawn(tree, nothing());
    run.steps(1000);
    double moved = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        moved = std::max(moved, (run.state.x_w[i] - drawn.state.x_w[i]).norm());
        moved = std::max(moved, (run.state.R_wb[i] - drawn.state.R_wb[i]).norm());
    }
    CHECK(run.largest_angle() > 1e-3);
    CHECK(moved < 1e-9);
}

TEST_CASE("Poses that gravity does not allow are refused by name") {
    Tree tree = make_tree::chain(4, 2, 0.02, 0.02);
    Scene scene;
    scene.gravity = Vec3(-1, -9.81, 0);
    tree.stiffness[2] = Vec3(0, 0, 1);
    CHECK_THROWS_WITH(PlainRun<double>(tree, scene), Catch::Contains("body 2 of branch 0"));
    // A column well above its buckling load, exactly upright.
    Tree column = make_tree::chain(8, 4, 0.01, 0.01);
    scene.gravity = Vec3(0, -9.81, 0);
    scene.pose = Pose::settled;
    scene.stiffness_scale = 0.05;
    CHECK_THROWS_WITH(PlainRun<double>(column, scene), Catch::Contains("buckles"));
}
