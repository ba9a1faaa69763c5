// Error against run time: on trees whose answers are known from elsewhere, the table must say them.
#include "lib/reference/ring_down.h"
#include "lib/reference/work_precision.h"
#include "tests/make_tree.h"
#include "tests/paper_trees.h"
#include <catch2/catch.hpp>
#include <numbers>
#include <stdexcept>

using namespace bough;

namespace {

std::vector<TreeRange> range_of(const Tree& tree) {
    return {{0, tree.size_bodies(), 0}};
}

Scene gravity_switched_on() {
    Scene scene;
    scene.pose = Pose::rest;
    return scene;
}

ErrorReport report_of(const Tree& tree, const Scene& scene, const std::vector<Variant>& variants,
                      const std::vector<double>& steps, std::int64_t frames = 31) {
    const std::vector<TreeRange> ranges = range_of(tree);
    ErrorOptions options;
    options.steps_per_frame = steps;
    options.variants = variants;
    return measure_error({tree, ranges, scene, 30, frames}, options, [](std::int64_t, std::int64_t) {});
}

} // namespace

TEST_CASE("a damped sinusoid gives back its frequency and decay") {
    for (const double f : {0.9, 1.3, 2.7})
        for (const double d : {0.0, 0.2, 1.5}) {
            std::vector<double> y;
            for (int k = 0; k < 100; ++k) {
                const double t = 0.03 * k;
                y.push_back(std::exp(-d * t) * std::cos(2 * std::numbers::pi * f * t + 0.3));
            }
            const RingDown found = fit_damped_sinusoid(y, 0.03, 1);
            CHECK(found.frequency == Approx(f).epsilon(1e-6));
            CHECK(found.decay == Approx(d).margin(1e-6));
        }
}

TEST_CASE("a single rod's ring-down is its closed form") {
    make_tree::Wood wood;
    wood.damping = 0.01;
    const Tree tree = make_tree::chain(1, 2, 0.03, 0.03, 0, wood);
    const double about_joint = tree.inertia[0](0, 0) + tree.mass[0] * tree.com[0].squaredNorm();
    const double square = tree.stiffness[0][0] / about_joint, decay = wood.damping * square / 2;
    const double frequency = std::sqrt(square - decay * decay) / (2 * std::numbers::pi);
    const std::vector<TreeRange> ranges = range_of(tree);
    const Problem problem{tree, ranges, gravity_switched_on()};
    for (const Solver solver : {Solver::articulated_reference, Solver::analytic}) {
        // The paper's inertia is the rod's own: with it the analytic step has a single joint exactly.
        const RingDown found = ring_down(problem, {solver, JointInertia::paper}, 0.05 / frequency, [] {});
        CAPTURE(solver_name(solver));
        CHECK(found.frequency == Approx(frequency).epsilon(1e-6));
        CHECK(found.decay == Approx(decay).epsilon(1e-4));
    }
}

TEST_CASE("the first mode of many pieces is the cantilever's") {
    make_tree::Wood wood;
    wood.damping = 0;
    const Tree tree = make_tree::chain(80, 4, 0.03, 0.03, 0, wood);
    const std::vector<TreeRange> ranges = range_of(tree);
    Scene bare = gravity_switched_on();
    bare.gravity.setZero();
    const Mode mode = first_mode(make_plan<double>(tree, ranges, bare, {}, 0.01));
    // Springs E I / l of whole pieces: the clamped end is softer by half a piece.
    const double I = std::numbers::pi * std::pow(0.03, 4) / 4, line = wood.density * std::numbers::pi * 0.0009;
    const double beam = 1.8751 * 1.8751 / (2 * std::numbers::pi) * std::sqrt(wood.youngs * I / line) / 16;
    CHECK(mode.frequency == Approx(beam).epsilon(0.03));
}

TEST_CASE("the linearly implicit step converges to the reference at first order") {
    const ErrorReport report = report_of(paper_trees::chain(2e8, 0.06 / (2 * std::numbers::pi * 0.33)),
                                         gravity_switched_on(), {{Solver::articulated_implicit}}, {1, 2, 4, 8, 16});
    REQUIRE(report.runs.size() == 5);
    CHECK(report.reference_error < 1e-5);
    for (std::size_t k = 1; k < report.runs.size(); ++k) {
        const ErrorRun &coarse = report.runs[k - 1], &fine = report.runs[k];
        CHECK(coarse.error_rms / fine.error_rms > 1.8);
        CHECK(coarse.error_rms / fine.error_rms < 2.4);
    }
    CHECK(report.runs.back().error_model < 1e-3);
    CHECK(report.runs.back().error_rms < 0.01);
    // The same error in the units of the other columns.
    const ErrorRun& one = report.runs.front();
    CHECK(one.error_rms_height * report.height == Approx(one.error_rms * report.rms_deflection));
    CHECK(one.error_max_peak * report.peak_deflection == Approx(one.error_max * report.rms_deflection));
}

TEST_CASE("the analytic step converges at first order to its own limit, which is not the truth") {
    const Variant branch{Solver::analytic}, single{Solver::analytic, JointInertia::branch, true},
        paper{Solver::analytic, JointInertia::paper};
    const ErrorReport report = report_of(paper_trees::branched(2e8, 0.06 / (2 * std::numbers::pi * 1.1)),
                                         gravity_switched_on(), {branch, single, paper}, {1, 2, 4, 8, 16, 32}, 61);
    REQUIRE(report.runs.size() == 18);
    const auto model = [&](std::size_t first) { return report.runs[first].error_model; };
    for (std::size_t k = 1; k < 5; ++k) {
        CHECK(report.runs[k - 1].error_step / report.runs[k].error_step == Approx(2).epsilon(0.15));
        CHECK(report.runs[k].error_model == model(0));
    }
    CHECK(model(0) > 0.02);
    CHECK(model(0) < model(12)); // the inertia factor is nearer to the truth than the paper's own form
    // Float: the same but for rounding, and split into the same parts.
    CHECK(report.runs[6].precision == "float");
    CHECK(report.runs[6].error_arithmetic < 1e-4);
    CHECK(report.runs[6].error_arithmetic > 1e-9);
    CHECK(report.runs[6].error_rms == Approx(report.runs[0].error_rms).epsilon(1e-3));
}

TEST_CASE("what cannot run is non-finite, and what does not move has no error") {
    const Tree tree = paper_trees::chain(2e9, 0.01);
    const ErrorReport report = report_of(tree, gravity_switched_on(), {{Solver::articulated_explicit}}, {1, 4}, 11);
    for (const ErrorRun& run : report.runs) {
        CHECK_FALSE(run.finite);
        CHECK(std::isnan(run.error_rms));
    }
    Scene still = gravity_switched_on();
    still.gravity.setZero();
    CHECK_THROWS_AS(report_of(tree, still, {{Solver::analytic}}, {1}), std::domain_error);
}
