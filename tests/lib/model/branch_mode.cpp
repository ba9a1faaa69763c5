#include "lib/model/branch_mode.h"
#include "lib/growth/segment.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace simulate;

namespace {

using std::numbers::pi;

Tree rod(int pieces, double tip_radius, const Material& wood) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {Vec3(0, 0, 0), Vec3(0, 2, 0)};
    s.radius = {0.02, tip_radius};
    SegmentOptions options;
    options.segment_length = 2.0 / pieces * 1.0000001;
    return segment(s, wood, options);
}

// f1 = k D / L^2 sqrt(E / rho): 0.1399 for a uniform rod, 0.3469 for a cone to a point.
double beam_frequency(double k, const Material& wood) {
    return k * 0.04 / 4 * std::sqrt(wood.youngs_modulus / wood.density);
}

// The first frequency of the simulated rod, from upward zero crossings of its tip after a small push of every joint.
double simulated_frequency(const Tree& tree, JointInertia inertia) {
    Scene scene = nothing();
    scene.joint_inertia = inertia;
    scene.damping_scale = 0;
    const BranchModes modes = branch_modes(tree);
    PlainRun<double> run(tree, scene, 1.0 / 960);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) run.state.theta[i].x() = 1e-6 * modes.weight[i];
    state_update(run.plan, run.state);
    const std::size_t tip = tree.size_bodies() - 1;
    std::vector<double> crossing;
    double before = run.state.x_w[tip].dot(Vec3(1, 0, 1));
    for (int k = 1; k < 4000; ++k) {
        run.steps(1);
        const double now = run.state.x_w[tip].dot(Vec3(1, 0, 1));
        if (before < 0 && now >= 0) crossing.push_back((k - now / (now - before)) / 960);
        before = now;
    }
    REQUIRE(crossing.size() > 2);
    return double(crossing.size() - 1) / (crossing.back() - crossing.front());
}

} // namespace

TEST_CASE("Rayleigh's quotient gives a beam's first frequency") {
    const Material& wood = wood_presets().front();
    for (const int n : {5, 10, 20, 80, 320}) {
        CAPTURE(n);
        const double uniform = branch_modes(rod(n, 0.02, wood)).omega_bend[0] / (2 * pi);
        CHECK(uniform == Approx(beam_frequency(0.1399, wood)).epsilon(n == 5 ? 0.015 : 0.006));
        const double cone = branch_modes(rod(n, 0.00002, wood)).omega_bend[0] / (2 * pi);
        CHECK(cone == Approx(beam_frequency(0.3469, wood)).epsilon(0.06));
    }
    // Torsion of a uniform rod: quarter wave, f = sqrt(G / rho) / 4 L.
    const double twist = branch_modes(rod(40, 0.02, wood)).omega_twist[0] / (2 * pi);
    CHECK(twist == Approx(std::sqrt(wood.shear_modulus / wood.density) / 8).epsilon(0.01));
}

TEST_CASE("Segmentation does not change the simulated first frequency") {
    const Material& wood = wood_presets().front();
    const double truth = beam_frequency(0.1399, wood);
    // The trial shape is the static one, not quite the first mode: joints ring from 0.99 to 1.07 times its frequency.
    const double coarse = simulated_frequency(rod(5, 0.02, wood), JointInertia::branch);
    for (const int n : {5, 10, 20, 80, 320}) {
        CAPTURE(n);
        const double f = simulated_frequency(rod(n, 0.02, wood), JointInertia::branch);
        CHECK(f == Approx(truth).epsilon(0.07));
        CHECK(f == Approx(coarse).epsilon(0.035));
    }
    // The paper's own inertia rings higher the more pieces there are: 4.4 times the truth at 80.
    CHECK(simulated_frequency(rod(80, 0.02, wood), JointInertia::paper) > 2 * truth);
}

TEST_CASE("Damping decays the branch's first mode by its ratio") {
    const Material& wood = wood_presets().front();
    const Tree tree = rod(20, 0.02, wood);
    const double omega = branch_modes(tree).omega_bend[0];
    CHECK(tree.damping[7] * omega / 2 == Approx(wood.damping_ratio).epsilon(1e-9));
    PlainRun<double> run(tree, nothing(), 1.0 / 240);
    const BranchModes modes = branch_modes(tree);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) run.state.theta[i].x() = 1e-6 * modes.weight[i];
    state_update(run.plan, run.state);
    const double first = run.total_energy();
    const int periods = 5;
    run.steps(int(std::lround(periods * 2 * pi / omega * 240)));
    CHECK(std::log(first / run.total_energy()) == Approx(2 * periods * 2 * pi * wood.damping_ratio).epsilon(0.03));
}
