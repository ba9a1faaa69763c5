#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace simulate;

TEST_CASE("In a steady wind the tree comes to rest where wind, weight and springs balance") {
    // The balance is computed here from the final positions alone: (21)-(23) at rest, leaves folded, gravity, moments about each joint.
    const Tree tree = make_tree::branched();
    Scene scene;
    scene.wind = steady(10);
    PlainRun<double> run(tree, scene);
    run.steps(9000);
    const State<double>& s = run.state;
    const std::size_t n = tree.size_bodies();
    std::vector<Vec3> force(n), com(n), moment(n, Vec3::Zero());
    for (std::size_t i = 0; i < n; ++i) {
        com[i] = s.x_w[i] + s.R_wb[i] * tree.com[i];
        const Vec3 u(10, 0, 0), z = s.R_wb[i].col(2), y = s.R_wb[i].col(1), size = tree.size[i];
        const Vec3 across = u - u.dot(z) * z;
        if (tree.kind[i] == Kind::branch)
            force[i] = 0.6 * 1.2 * size[0] * (size[1] + size[2]) * across.norm() * across;
        else if (tree.kind[i] == Kind::fruit)
            force[i] = 0.235 * 1.2 * 3.14159265358979323846 * size[1] * size[1] * 10 * u;
        else
            force[i] = 0.6 * 1.2 * size[0] * size[1] / 2 * 10 / (1 + 10 / 7.5) * (0.75 * u.dot(y) * y + 0.25 * u);
        force[i] += tree.mass[i] * scene.gravity;
        for (std::size_t j = i;; j = std::size_t(tree.parent[j])) {
            moment[j] += (com[i] - s.x_w[j]).cross(force[i]);
            if (tree.parent[j] < 0) break;
        }
    }
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        CHECK(s.theta_dot[i].norm() < 1e-9);
        const Vec3 spring = body_rate_jacobian_inverse(s.theta[i]).transpose() * run.plan.K[i].cwiseProduct(s.theta[i]);
        CHECK((s.R_wb[i].transpose() * moment[i] - spring).norm() <= 1e-9 * (1e-6 + spring.norm()));
        largest = std::max(largest, (s.theta[i] - run.plan.theta_start[i]).norm());
    }
    CHECK(largest > 1e-3); // the wind did bend it
}

TEST_CASE("A rod on a free joint slows in still air as the equation of motion says") {
    // I w' = -c |w| w with c = kappa rho A l_c^3: w = w0 / (1 + c w0 t / I).
    Tree tree = make_tree::chain(1, 1, 0.0015, 0.0015);
    tree.stiffness[0].setZero();
    Scene scene = nothing();
    scene.wind = still_air();
    const double l = tree.com[0].z(), I = tree.inertia[0](0, 0) + tree.mass[0] * l * l;
    const double c = 0.6 * 1.2 * 0.003 * l * l * l, w0 = 6;
    const auto speed = [&](double dt) {
        PlainRun<double> run(tree, scene, dt);
        run.state.theta_dot[0] = Vec3(w0, 0, 0);
        parts::scaled_rate(run.state)[0] = Vec3(std::sqrt(I) * w0, 0, 0);
        state_update(run.plan, run.state);
        run.steps(int(std::lround(0.4 / dt)));
        return run.state.theta_dot[0].norm();
    };
    const double truth = w0 / (1 + c * w0 * 0.4 / I);
    REQUIRE(truth < 0.8 * w0);
    CHECK(speed(1.0 / 30) == Approx(truth).epsilon(0.02));
    CHECK(speed(1.0 / 300) == Approx(truth).epsilon(0.002));
    CHECK(speed(1.0 / 3000) == Approx(truth).epsilon(0.0002));
}

TEST_CASE("A twig in a gale is dragged along, never past the wind") {
    // Half a millimetre thick, 60 m/s, one step a frame: explicit drag overflows here within ten frames.
    make_tree::Wood soft;
    soft.youngs = 1e6;
    soft.shear = 1e5;
    const Tree tree = make_tree::chain(20, 0.5, 0.0005, 0.0002, 0, soft);
    Scene scene = nothing();
    scene.wind = steady(60);
    PlainRun<float> run(tree, scene);
    for (int k = 0; k < 900; ++k) {
        run.steps(1);
        for (const auto& v : run.state.v_w) {
            REQUIRE(v.allFinite());
            REQUIRE(v.norm() < 200);
        }
    }
    CHECK(run.largest_angle() < 3.14159f);
}
