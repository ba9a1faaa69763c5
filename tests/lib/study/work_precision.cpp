// Error against run time: on trees whose answers are known from elsewhere, the table must say them.
#include "lib/study/work_precision.h"
#include "lib/study/ring_down.h"
#include "lib/study/trajectory_difference.h"
#include "tests/support/make_tree.h"
#include "tests/support/paper_trees.h"
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
    // The coupled step has its scheme's: P34's is right here, LIE multiplies the rod's motion by 1 / (1 + h d - i h w), about.
    const double h = 0.05 / frequency, w = 2 * std::numbers::pi * frequency;
    const auto coupled = [&](Scheme scheme) {
        return ring_down(problem, {.solver = Solver::coupled, .scheme = scheme}, h, [] {});
    };
    CHECK(coupled(Scheme::p34).frequency == Approx(frequency).epsilon(1e-6));
    CHECK(coupled(Scheme::p34).decay == Approx(decay).epsilon(1e-4));
    CHECK(coupled(Scheme::lie).decay == Approx(std::log(std::hypot(1 + h * decay, h * w)) / h).epsilon(1e-3));
}

TEST_CASE("the first mode of many pieces is the cantilever's") {
    make_tree::Wood wood;
    wood.damping = 0;
    const Tree tree = make_tree::chain(80, 4, 0.03, 0.03, 0, wood);
    const std::vector<TreeRange> ranges = range_of(tree);
    Scene bare = gravity_switched_on();
    bare.gravity.setZero();
    const Mode mode = first_mode(make_plan<double>(tree, ranges, bare, {}, 0.01, Solver::analytic));
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

namespace {

Variant coupled_by(Scheme scheme, bool single = false) {
    return {.solver = Solver::coupled, .single = single, .scheme = scheme};
}

ErrorReport chain_report(const std::vector<Variant>& variants, const std::vector<double>& steps) {
    return report_of(paper_trees::chain(2e9, 0.06 / (2 * std::numbers::pi * 1.05)), gravity_switched_on(), variants,
                     steps, 61);
}

} // namespace

TEST_CASE("the coupled step converges to the reference: what is left of it as a model is the reference's own error") {
    const ErrorReport report = chain_report({coupled_by(Scheme::p12)}, {1, 2, 4, 8, 16, 32, 64});
    REQUIRE(report.runs.size() == 7);
    CHECK(report.runs[0].solver == "coupled");
    CHECK(report.runs[0].scheme == "P12");
    CHECK(report.reference_error < 1e-5);
    for (const ErrorRun& run : report.runs) CHECK(run.error_model < report.reference_error);
    for (std::size_t k = 1; k < 4; ++k) // the second order of its nonlinear terms, or better
        CHECK(report.runs[k - 1].error_rms / report.runs[k].error_rms > 3.5);
    CHECK(report.runs[0].error_rms_peak < 0.005);
    CHECK(report.runs[0].error_step == Approx(report.runs[0].error_rms).epsilon(1e-2));
}

TEST_CASE("the limit of small steps is found at the order that the runs show") {
    // Taken as first order, P34's limit would be off by twice the finest run's error; as second, LIE's by a third.
    struct Case {
        Scheme scheme;
        double ratio;
        std::vector<double> steps;
    };
    for (const Case& c : {Case{Scheme::p34, 4, {2, 4, 8}}, Case{Scheme::lie, 2, {16, 32, 64}}}) {
        CAPTURE(scheme_of(c.scheme).name);
        const ErrorReport report = chain_report({coupled_by(c.scheme)}, c.steps);
        REQUIRE(report.runs.size() == 3);
        CHECK(report.runs[1].error_rms / report.runs[2].error_rms == Approx(c.ratio).epsilon(0.06));
        CHECK(report.runs[2].error_model < 0.1 * report.runs[2].error_rms);
    }
}

TEST_CASE("schemes are series of their own, with one limit: that of the one nearest to it") {
    const ErrorReport report =
        chain_report({coupled_by(Scheme::lie), coupled_by(Scheme::p12), coupled_by(Scheme::p12, true)}, {4, 8, 16});
    REQUIRE(report.runs.size() == 9);
    const auto is = [&](std::size_t k, const char* scheme, const char* precision) {
        return report.runs[k].scheme == scheme && report.runs[k].precision == precision;
    };
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(is(k, "LIE", "double"));
        CHECK(is(3 + k, "P12", "double"));
        CHECK(is(6 + k, "P12", "float"));
        CHECK(report.runs[k].error_model == report.runs[3].error_model);
        CHECK(report.runs[6 + k].error_model == report.runs[3].error_model);
        CHECK(std::isnan(report.runs[k].error_arithmetic));
        CHECK(report.runs[6 + k].error_arithmetic < 1e-4); // against P12 in double, from which LIE is far
        CHECK(report.runs[6 + k].error_arithmetic > 1e-9);
        CHECK(report.runs[k].error_rms > 100 * report.runs[3 + k].error_rms);
    }
    CHECK(report.runs[0].error_model < 1e-4);
}

TEST_CASE("the usual series begin with each solver's default, in double") {
    const std::vector<Variant> all = all_variants();
    CHECK(all.front().solver == Solver::coupled);
    CHECK(all.front().scheme == Scheme());
    std::vector<Solver> seen;
    for (const Variant& v : all) {
        const bool first = std::find(seen.begin(), seen.end(), v.solver) == seen.end();
        if (!first) continue;
        seen.push_back(v.solver);
        CHECK_FALSE(v.single);
        CHECK(v.inertia == JointInertia::branch);
    }
    CHECK(seen.size() + 1 == all_solvers.size()); // all but the reference
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

TEST_CASE("distances and deflections of points are those of their coordinates, of all of them or of some") {
    // Two points over four frames: the first goes by 3, 4 and 5 along x, the second stays.
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
    const Points a = {{x, y}, {4 * x, y}, {5 * x, y}, {6 * x, y}};
    const std::vector<std::size_t> first = {0}, second = {1};
    CHECK(deflection(a).rms == Approx(std::sqrt((9 + 16 + 25) / 6.0)));
    CHECK(deflection(a).most == Approx(5));
    CHECK(deflection(a, &first).rms == Approx(std::sqrt(50 / 3.0)));
    CHECK(deflection(a, &second).most == 0);
    // The other run lies off by 1, 2 and 2 at the second point, and has other starts, which are not compared.
    const Points b = {{9 * x, 9 * y}, {4 * x, 2 * y}, {5 * x, -y}, {6 * x, 3 * y}};
    CHECK(distance(a, 1, b, 1).rms == Approx(std::sqrt((1 + 4 + 4) / 6.0)));
    CHECK(distance(a, 1, b, 1, &second).rms == Approx(std::sqrt(3.0)));
    CHECK(distance(a, 1, b, 1, &second).most == Approx(2));
    CHECK(distance(a, 1, b, 1, &first).most == 0);
    // One has every second frame alone.
    const Points coarse = {b[0], b[2]};
    CHECK(distance(coarse, 2, a, 1, &second).rms == Approx(2));
    CHECK(std::isnan(distance({a[0]}, 1, b, 1).rms));
}

TEST_CASE("wood is sorted by branch level, leaves and fruit left out") {
    const Tree tree = make_tree::branched();
    const std::vector<std::size_t> wood = wood_bodies(tree);
    const WoodLevels levels = wood_levels(tree);
    std::size_t all = 0;
    for (std::size_t level = 0; level < levels.level.size(); ++level)
        for (const std::size_t k : levels.level[level]) {
            CHECK(tree.kind[wood[k]] == Kind::branch);
            CHECK(tree.level[wood[k]] == std::int32_t(level));
            ++all;
        }
    CHECK(all == wood.size());
    CHECK(levels.level.size() >= 3);
    CHECK(levels.to_one.size() == levels.level[0].size() + levels.level[1].size());
}

TEST_CASE("wood and statistics of a run: those of the coupled step at 64 steps are the reference's, which either truth "
          "says") {
    const Tree tree = make_tree::branched();
    const std::vector<TreeRange> ranges = range_of(tree);
    Scene scene;
    scene.wind = wind_preset("breeze");
    ErrorOptions options;
    options.steps_per_frame = {0.5, 64};
    options.variants = {{.solver = Solver::coupled}};
    const auto report = [&](Truth truth) {
        options.truth = truth;
        return measure_error({tree, ranges, scene, 30, 31}, options, [](std::int64_t, std::int64_t) {});
    };
    const ErrorReport reference = report(Truth::reference), fine = report(Truth::fine);
    CHECK(reference.truth == "articulated-reference");
    CHECK(fine.truth == "coupled, 64 steps a frame");
    // A step over two frames has no turn a frame; pointwise errors it has.
    CHECK(reference.runs[0].motion.frames == 0);
    CHECK(reference.runs[0].error_wood.rms > 0);
    const ErrorRun& run = reference.runs[1];
    CHECK(run.motion.frames == 30);
    REQUIRE(run.error_level.size() == reference.level_deflection.size());
    for (std::size_t k = 0; k < run.error_level.size(); ++k) {
        const PointError& e = run.error_level[k];
        CHECK(e.rms < 0.01);
        CHECK(e.rms <= e.max);
        CHECK(e.max_peak * reference.level_deflection[k].peak == Approx(e.max * reference.level_deflection[k].rms));
    }
    CHECK(run.motion.top.spread == Approx(reference.motion.top.spread).epsilon(0.01));
    CHECK(run.motion.leaves.turn == Approx(reference.motion.leaves.turn).epsilon(0.02));
    CHECK(run.error_spectrum < 0.05);
    CHECK(fine.motion.top.lean == Approx(reference.motion.top.lean).epsilon(0.01));
    CHECK(fine.runs[1].error_wood.max < 1e-9); // it is the truth itself
    CHECK(fine.reference_error < 0.01);
    CHECK(fine.frequency == Approx(reference.frequency).epsilon(0.01));
}
