#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>
#include <random>

using namespace bough;
using namespace simulate;

namespace {

// A chain tilted by 0.7 rad and thrown out of rest: every joint bent and turning.
PlainRun<double> thrown_chain(int n, double youngs, double beta, const Scene& scene) {
    make_tree::Wood wood;
    wood.youngs = youngs;
    wood.shear = youngs / 15;
    wood.damping = beta;
    Tree tree = make_tree::chain(n, 2, 0.01, 0.01, 0, wood);
    tree.joint_rotation[0] = make_tree::turn(0.7, Vec3::UnitZ()) * tree.joint_rotation[0];
    PlainRun<double> run(tree, scene);
    for (int i = 0; i < n; ++i)
        run.state.theta[std::size_t(i)] = 2.0 / n * Vec3(std::sin(1 + 0.7 * i), std::cos(2.0 * i), 0);
    state_update(run.plan, run.state);
    return run;
}

// The largest rise of the energy in one step, relative to the start's.
double largest_rise(PlainRun<double>& run, int steps) {
    const double first = run.total_energy();
    double before = first, rise = 0;
    for (int k = 0; k < steps; ++k) {
        run.steps(1);
        const double now = run.total_energy();
        REQUIRE(std::isfinite(now));
        rise = std::max(rise, now - before);
        before = now;
    }
    return rise / std::abs(first);
}

} // namespace

TEST_CASE("A chain in still air loses energy in every step") {
    const int n = GENERATE(1, 3, 20, 400);
    const double beta = GENERATE(0.0, 0.01);
    CAPTURE(n, beta);
    Scene scene = nothing();
    scene.wind = still_air();
    PlainRun<double> run = thrown_chain(n, 1e9, beta, scene);
    const double first = run.total_energy();
    CHECK(largest_rise(run, 300) <= 1e-12);
    CHECK(run.total_energy() < first);
}

TEST_CASE("A chain under gravity, without and with air, gains no energy") {
    const int n = GENERATE(1, 3, 20, 400);
    const double beta = GENERATE(0.0, 0.01);
    const bool air = GENERATE(false, true);
    CAPTURE(n, beta, air);
    Scene scene = nothing();
    scene.gravity = Vec3(0, -9.81, 0);
    if (air) scene.wind = still_air();
    PlainRun<double> run = thrown_chain(n, 1e9, beta, scene);
    // One rod swings by half a radian a step: what is left over is of third order in that.
    CHECK(largest_rise(run, 300) <= (n == 1 ? 1e-3 : 1e-9));
}

TEST_CASE("Without damping, air and gravity the joints keep their energy") {
    const int n = GENERATE(1, 3, 20, 400);
    CAPTURE(n);
    PlainRun<double> run = thrown_chain(n, 1e9, 0, nothing());
    const double first = run.total_energy();
    run.steps(1000);
    CHECK(run.total_energy() == Approx(first).epsilon(1e-9));
}

TEST_CASE("Energy does not rise at any stiffness") {
    // Without gravity down to free joints; with gravity over the promised range, on a tree that wood can carry (a softer one
    // folds up, by more than the small rotations a step that gravity's bound is for).
    const double scale = GENERATE(0.0, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12);
    const bool gravity = GENERATE(false, true);
    if (gravity && scale < 1) return;
    CAPTURE(scale, gravity);
    Scene scene = nothing();
    scene.stiffness_scale = scale;
    Tree tree = make_tree::random_tree(200, 3);
    if (gravity) {
        scene.gravity = Vec3(0, -9.81, 0);
        tree = segment(grow_bodies(default_growth(), 2, {true, false, true}, 300), wood_presets().front(), {});
    }
    PlainRun<double> run(tree, scene);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    // Kicks of a tenth of a joule in all, shared out by inertia.
    const double share = std::sqrt(0.2 / (3 * double(tree.size_bodies())));
    for (Vec3& w : parts::scaled_rate(run.state)) w = Vec3(normal(random), normal(random), normal(random)) * share;
    const double first = run.total_energy();
    double before = first, rise = 0;
    for (int k = 0; k < 600; ++k) {
        run.steps(1);
        const double now = run.total_energy();
        REQUIRE(std::isfinite(now));
        rise = std::max(rise, now - before);
        before = now;
    }
    CHECK(rise <= 1e-9 * std::abs(first));
}

TEST_CASE("A single pendulum keeps its energy to second order of the step") {
    // Rest angle 0.3 rad off the vertical, hanging and standing on a spring that holds it.
    const bool hanging = GENERATE(true, false);
    CAPTURE(hanging);
    Tree tree = make_tree::chain(1, 0.5, 0.02, 0.02);
    tree.joint_rotation[0] =
        make_tree::turn(hanging ? 3.14159265358979323846 - 0.3 : 0.3, Vec3::UnitZ()) * tree.joint_rotation[0];
    tree.damping[0] = 0;
    const double moment = tree.mass[0] * 9.81 * tree.com[0].z();
    tree.stiffness[0] = Vec3::Constant(hanging ? 0 : 3 * moment);
    Scene scene = nothing();
    scene.gravity = Vec3(0, -9.81, 0);
    const auto change = [&](double dt) {
        PlainRun<double> run(tree, scene, dt);
        const double lowest = -moment; // hanging straight down
        const double first = run.total_energy();
        double most = 0;
        for (int k = 0; k < int(20 / dt); ++k) {
            run.steps(1);
            most = std::max(most, std::abs(run.total_energy() - first));
        }
        return most / (hanging ? first - lowest : moment * (1 - std::cos(0.3)));
    };
    const double coarse = change(1.0 / 30), fine = change(1.0 / 60);
    CHECK(coarse < 0.05);
    CHECK(fine < coarse / 2);
}
