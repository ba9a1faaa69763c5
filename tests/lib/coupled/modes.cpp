// What the coupled step makes of a beam's first mode, and of the energy of a large undamped swing.
#include "lib/growth/segment.h"
#include "lib/study/ring_down.h"
#include "tests/support/coupled_support.h"
#include <numbers>

using namespace bough;
using namespace coupled;

namespace {

using std::numbers::pi;
constexpr double length = 2, diameter = 0.04;

// A uniform cantilever of f1 = 0.1399 D / L^2 sqrt(E / rho) = 1 Hz, cut into n pieces.
Tree cantilever(int n) {
    Splines s;
    s.parent = {-1};
    s.parent_at = {0};
    s.level = {0};
    s.first_point = {0, 2};
    s.point = {Vec3(0, 0, 0), Vec3(0, length, 0)};
    s.radius = {diameter / 2, diameter / 2};
    Material wood = wood_presets().front();
    wood.youngs_modulus = wood.density * std::pow(length * length / (0.1399 * diameter), 2);
    SegmentOptions options;
    options.segment_length = length / n * 1.0000001;
    return segment(s, wood, options);
}

// First frequency [Hz] of n rigid rods in a line, their joints about one axis: K x = omega^2 M x, M by its definition.
double rods_frequency(const Tree& tree) {
    const auto n = Eigen::Index(tree.size_bodies());
    const double rod = length / double(n), c = rod / 2;
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n), K = M;
    for (Eigen::Index i = 0; i < n; ++i) {
        K(i, i) = tree.stiffness[std::size_t(i)].x();
        for (Eigen::Index j = 0; j <= i; ++j)
            for (Eigen::Index k = 0; k <= i; ++k)
                M(j, k) += tree.mass[std::size_t(i)] * (double(i - j) * rod + c) * (double(i - k) * rod + c) +
                           tree.inertia[std::size_t(i)](0, 0);
    }
    // 1 / omega^2 is the largest eigenvalue of K^-1 M; the others are less than 1/39 of it.
    Eigen::VectorXd x = Eigen::VectorXd::Ones(n);
    double value = 0;
    for (int k = 0; k < 12; ++k) {
        x = K.diagonal().cwiseInverse().asDiagonal() * (M * x).eval();
        value = x.norm();
        x /= value;
    }
    return 1 / std::sqrt(value) / (2 * pi);
}

// Let go at 1/30 s from a small bend that falls like a cantilever's towards its tip: the tip's motion over 15 periods.
RingDown ring(const Tree& tree, double beta, Scheme scheme = Scheme::p12) {
    Tree damped = tree;
    for (double& b : damped.damping) b = beta;
    CoupledRun<double> run(damped, solver::empty_scene(), scheme);
    const std::size_t n = run.plan.bodies;
    for (std::size_t i = 0; i < n; ++i) {
        const double s = 1 - double(i) / double(n);
        run.state.theta[i].x() = 0.01 / double(n) * (i == 0 ? 0.5 : s * s);
    }
    state_update(run.plan, run.state);
    std::vector<double> tip;
    for (int k = 0; k < 450; ++k) {
        tip.push_back((run.state.x_w[n - 1] + run.state.R_wb[n - 1].col(2) * tree.size[n - 1][0]).dot(Vec3(1, 0, 1)));
        run.steps(1);
    }
    return fit_damped_sinusoid(tip, 1.0 / 30, 1);
}

} // namespace

TEST_CASE("the first frequency of a cantilever is the beam's within 1 % at 1/30 s, for 10 to 320 pieces") {
    for (const int n : {5, 10, 20, 40, 80, 160, 320}) {
        const Tree tree = cantilever(n);
        REQUIRE(tree.size_bodies() == std::size_t(n));
        const double f = ring(tree, 0).frequency;
        CAPTURE(n, f);
        CHECK(f == Approx(rods_frequency(tree)).epsilon(1e-4));
        // Five rigid rods are themselves 1.8 % slower than the beam, which is the cutting's error, not the step's.
        CHECK(f == Approx(1).epsilon(n == 5 ? 0.02 : 0.01));
    }
}

TEST_CASE("its decay is beta omega^2 / 2") {
    for (const int n : {5, 80})
        for (const double ratio : {0.01, 0.03, 0.1}) {
            const Tree tree = cantilever(n);
            const double omega = 2 * pi * rods_frequency(tree);
            const RingDown found = ring(tree, 2 * ratio / omega);
            CAPTURE(n, ratio, found.decay);
            // (P12's own, case below, is 1.3e-4 of omega.)
            CHECK(found.decay == Approx(ratio * omega).epsilon(0.02));
            CHECK(found.frequency * 2 * pi == Approx(std::sqrt(1 - ratio * ratio) * omega).epsilon(1e-3));
        }
}

// The scheme's own damping is that of scheme.h: nearly nothing at 1 Hz.
TEST_CASE("without damping P12 takes a damping ratio of (omega h)^3 / 72 from it, P34 nothing") {
    const double y = 2 * pi / 30, omega = 2 * pi;
    CHECK(ring(cantilever(20), 0).decay / omega == Approx(y * y * y / 72).epsilon(0.1));
    CHECK(std::abs(ring(cantilever(20), 0, Scheme::p34).decay) / omega < 2e-6);
}

TEST_CASE("energy of a large undamped swing after 10 s at 1/30 s") {
    for (const auto& [scheme, least] : {std::pair{Scheme::p12, 0.8}, std::pair{Scheme::p50, 0.87}}) {
        Scene scene;
        scene.damping_scale = 0;
        scene.pose = Pose::settled;
        CoupledRun<double> run(paper_trees::chain(2e9, 0), scene, scheme);
        const double rest = run.total_energy();
        for (Vec3& theta : run.state.theta) theta.setZero();
        state_update(run.plan, run.state);
        const double start = run.total_energy() - rest;
        run.steps(300);
        const double kept = (run.total_energy() - rest) / start;
        CAPTURE(scheme_of(scheme).name, kept);
        CHECK(kept >= least);
        CHECK(kept < 1);
    }
}
