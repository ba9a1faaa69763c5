#include "work_precision.h"
#include "ring_down.h"
#include "trajectory_difference.h"
#include <algorithm>
#include <optional>
#include <stdexcept>

namespace bough {
namespace {

constexpr double quick = 0.1;         // [s] below it a run is repeated, the fastest counts
constexpr double ringing_up_to = 8;   // steps a frame
constexpr double reference_cost = 60; // of its passes in a frame, for the progress alone
constexpr double fine_steps = 64;     // a frame, of the coupled solver as the truth
constexpr double fine_ringing = 16;   // the same in the ring-down, which is small and slow

bool same_series(const Variant& a, const Variant& b) {
    return a.solver == b.solver && a.inertia == b.inertia && a.scheme == b.scheme;
}

// Limit of small steps by a solver's three finest runs; none where they do not converge (work_precision.h).
std::optional<Trajectory> limit_of(const std::vector<Trajectory>& runs) {
    if (runs.size() < 3) return std::nullopt;
    const Trajectory &fine = runs.back(), &coarse = runs[runs.size() - 2], &coarser = runs[runs.size() - 3];
    if (!coarser.finite || !coarse.finite || !fine.finite || coarse.stride != 1) return std::nullopt;
    const double before = distance(coarse, coarser).rms, last = distance(fine, coarse).rms;
    if (!(last < 0.75 * before)) return std::nullopt;
    const double weight = 1 / (std::clamp(before / last, 2.0, 8.0) - 1);
    Trajectory limit;
    limit.tip = fine.tip;
    for (std::size_t f = 0; f < limit.tip.size(); ++f)
        for (std::size_t k = 0; k < limit.tip[f].size(); ++k)
            limit.tip[f][k] += weight * (fine.tip[f][k] - coarse.tip[f][k]);
    return limit;
}

// What the rows of a series say of its limit.
struct Limit {
    double left = 0;  // [m] from the finest run to it
    Distance model{}; // from it to the reference
};

struct Bench {
    const Problem& problem;
    const ErrorOptions& options;
    const std::function<void(std::int64_t, std::int64_t)>& progress;
    double done = 0, total = 1, unit = 1;
    Trajectory truth;
    double height = 0, rms = 0, peak = 0; // [m]
    WoodLevels levels;
    RingDown ring;
    ErrorReport report;
    std::vector<Variant> rows;                     // what report.runs are of
    std::vector<std::pair<Variant, Limit>> limits; // of each series that has one

    void start(double frame_cost) { unit = frame_cost; }
    std::function<void()> tick() {
        return [this] {
            done += unit;
            progress(std::int64_t(std::min(999.0, 1000 * done / total)), 1000);
        };
    }
    double ring_dt(double steps) const { return 1 / (problem.fps * steps); }
    bool rings(const Variant& v) const { return !v.single && v.steps_per_frame <= ringing_up_to; }

    void find_truth();
    void measure_deflection();
    void compare_wood(const Trajectory&, ErrorRun&) const;
    Trajectory timed(const Variant&);
    ErrorRun row(const Variant&, const Trajectory&, const Trajectory* same_in_double,
                 const std::optional<Trajectory>& limit);
    void series(const std::vector<Variant>& in_double, const Variant* in_float);
    void add(const Variant&, const ErrorRun&);
    void find_models();
};

Deflection in_metres(const Distance& d) {
    return {d.rms, d.most};
}

void Bench::measure_deflection() {
    const std::vector<Vec3>& drawn = truth.tip.front();
    const Distance tips = deflection(truth.tip);
    rms = tips.rms;
    peak = tips.most;
    double lowest = INFINITY, highest = -INFINITY;
    for (std::size_t i = 0; i < problem.tree.size_bodies(); ++i)
        if (problem.tree.parent[i] < 0) lowest = std::min(lowest, problem.tree.joint_position[i].y());
    for (const Vec3& x : drawn) highest = std::max(highest, x.y());
    height = std::max(highest - lowest, 1e-12);
    levels = wood_levels(problem.tree);
    for (const std::vector<std::size_t>& level : levels.level)
        report.level_deflection.push_back(in_metres(deflection(truth.wood, &level)));
    report.wood_deflection = in_metres(deflection(truth.wood, &levels.to_one));
}

void Bench::find_truth() {
    Variant exact{Solver::articulated_reference, JointInertia::branch, false, 1, options.tolerance};
    if (options.truth == Truth::fine) exact = {.solver = Solver::coupled, .steps_per_frame = fine_steps};
    start(reference_cost);
    truth = run_trajectory(problem, exact, true, 1, tick());
    if (!truth.finite) throw std::domain_error("the reference solution became non-finite");
    report.reference_seconds = truth.seconds / (double(problem.frames - 1) / problem.fps);
    measure_deflection();
    if (!(rms > 0)) throw std::domain_error("nothing moves in the reference solution: there is no error to measure");
    Variant rough = exact;
    rough.tolerance *= 10;
    rough.steps_per_frame = options.truth == Truth::fine ? fine_steps / 2 : 1;
    const Distance again = distance(run_trajectory(problem, rough, false, 1, tick()), truth);
    report.reference_error = again.rms / rms;
    report.reference_error_max = again.most / rms;
    if (truth.flags.unresolved > 0) report.reference_error = std::max(report.reference_error, 1.0);
    exact.tolerance = std::max(options.tolerance, 1e-8);
    const double ringing =
        options.truth == Truth::fine ? ring_dt(fine_ringing) : std::min(1 / 120.0, 0.25 / problem.fps);
    ring = ring_down(problem, exact, ringing, [] {});
    report.truth = options.truth == Truth::fine ? "coupled, 64 steps a frame" : solver_name(exact.solver);
    report.frequency = ring.frequency;
    report.decay = ring.decay;
    report.motion = truth.motion;
}

// Of the wood, each level and that to level 1.
void Bench::compare_wood(const Trajectory& run, ErrorRun& r) const {
    const auto shares = [&](const std::vector<std::size_t>& of, const Deflection& whole) {
        const Distance d = distance(run.wood, run.stride, truth.wood, truth.stride, &of);
        return PointError{d.rms / whole.rms, d.most / whole.rms, d.rms / whole.peak, d.most / whole.peak};
    };
    for (std::size_t k = 0; k < levels.level.size(); ++k)
        r.error_level.push_back(shares(levels.level[k], report.level_deflection[k]));
    r.error_wood = shares(levels.to_one, report.wood_deflection);
}

Trajectory Bench::timed(const Variant& v) {
    start(v.steps_per_frame >= 1 ? v.steps_per_frame : 1);
    Trajectory run = run_trajectory(problem, v, true, 1, tick());
    if (run.seconds >= quick || !run.finite) return run;
    start(0);
    const Trajectory again = run_trajectory(problem, v, false, 2, tick());
    run.seconds = std::min(run.seconds, again.seconds);
    return run;
}

ErrorRun Bench::row(const Variant& v, const Trajectory& run, const Trajectory* same_in_double,
                    const std::optional<Trajectory>& limit) {
    ErrorRun r;
    r.solver = solver_name(v.solver);
    r.scheme = v.solver == Solver::coupled         ? scheme_of(v.scheme).name
               : v.solver != Solver::analytic      ? "euler"
               : v.inertia == JointInertia::branch ? "inertia-branch"
                                                   : "inertia-paper";
    r.precision = v.single ? "float" : "double";
    r.steps_per_frame = v.steps_per_frame;
    r.finite = run.finite;
    if (!run.finite) return r;
    const double seconds = double(std::int64_t(run.tip.size() - 1) * run.stride) / problem.fps;
    r.seconds_per_simulated_second = run.seconds / seconds;
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(run.hash));
    r.hash = text;
    const Distance error = distance(run, truth);
    r.error_rms = error.rms / rms;
    r.error_max = error.most / rms;
    r.error_rms_peak = error.rms / peak;
    r.error_max_peak = error.most / peak;
    r.error_rms_height = error.rms / height;
    r.error_max_height = error.most / height;
    r.error_angle = angle_distance(run, truth);
    compare_wood(run, r);
    r.motion = run.motion;
    r.error_spectrum = spectrum_difference(run.motion.leaves, truth.motion.leaves);
    if (limit) {
        const Distance step = distance(same_in_double ? *same_in_double : run, *limit);
        r.error_step = step.rms / rms;
        r.error_step_max = step.most / rms;
    }
    if (same_in_double) {
        const Distance arithmetic = distance(run, *same_in_double);
        r.error_arithmetic = arithmetic.rms / rms;
        r.error_arithmetic_max = arithmetic.most / rms;
    }
    if (rings(v)) {
        start(v.steps_per_frame);
        const RingDown own = ring_down(problem, v, ring_dt(v.steps_per_frame), [] {});
        r.error_frequency = own.frequency / ring.frequency - 1;
        r.error_decay = own.decay / ring.decay - 1;
    }
    return r;
}

// The rows of one solver and scheme: double, then float, whose limit and arithmetic need the double ones.
void Bench::series(const std::vector<Variant>& variants, const Variant* in_float) {
    std::vector<Trajectory> runs;
    for (const Variant& v : variants) runs.push_back(timed(v));
    std::optional<Trajectory> limit;
    const std::size_t n = variants.size();
    if (n >= 3 && variants[n - 1].steps_per_frame == 2 * variants[n - 2].steps_per_frame &&
        variants[n - 2].steps_per_frame == 2 * variants[n - 3].steps_per_frame)
        limit = limit_of(runs);
    if (limit) limits.push_back({variants.front(), {distance(runs.back(), *limit).rms, distance(*limit, truth)}});
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const bool shown = std::any_of(options.variants.begin(), options.variants.end(),
                                       [&](const Variant& v) { return same_series(v, variants[k]) && !v.single; });
        if (shown) add(variants[k], row(variants[k], runs[k], nullptr, limit));
    }
    if (!in_float) return;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        Variant v = variants[k];
        v.single = true;
        add(v, row(v, timed(v), &runs[k], limit));
    }
}

void Bench::add(const Variant& v, const ErrorRun& run) {
    rows.push_back(v);
    report.runs.push_back(run);
}

// Of each row whose solver has a limit: by the scheme that needed the least extrapolation.
void Bench::find_models() {
    for (std::size_t k = 0; k < rows.size(); ++k) {
        Limit best{INFINITY, {}};
        for (const auto& [v, limit] : limits)
            if (v.solver == rows[k].solver && v.inertia == rows[k].inertia && limit.left < best.left) best = limit;
        if (!report.runs[k].finite) continue;
        report.runs[k].error_model = best.model.rms / rms;
        report.runs[k].error_model_max = best.model.most / rms;
    }
}

} // namespace

std::vector<Variant> all_variants() {
    std::vector<Variant> all;
    const auto add = [&all](Solver solver, Scheme scheme, JointInertia inertia, bool single) {
        all.push_back({.solver = solver, .inertia = inertia, .single = single, .scheme = scheme});
    };
    for (const bool single : {false, true}) add(Solver::coupled, Scheme::p12, JointInertia::branch, single);
    for (const Scheme scheme : {Scheme::p34, Scheme::p50, Scheme::lie})
        add(Solver::coupled, scheme, JointInertia::branch, false);
    for (const JointInertia inertia : {JointInertia::branch, JointInertia::paper})
        for (const bool single : {false, true}) add(Solver::analytic, Scheme::p12, inertia, single);
    for (const Solver solver : {Solver::articulated_implicit, Solver::articulated_explicit})
        add(solver, Scheme::p12, JointInertia::branch, false);
    return all;
}

ErrorReport measure_error(const Problem& problem, const ErrorOptions& options,
                          const std::function<void(std::int64_t, std::int64_t)>& progress) {
    Bench bench{problem, options, progress, 0, 1, 1, {}, 0, 0, 0, {}, {}, {}, {}, {}};
    double a_series = 0;
    for (const double steps : options.steps_per_frame) a_series += std::max(1.0, steps);
    bench.total = double(problem.frames - 1) * (2 * reference_cost + a_series * double(options.variants.size()));
    bench.find_truth();
    ErrorReport& report = bench.report;
    report.bodies = std::int64_t(problem.tree.size_bodies());
    report.tips = std::int64_t(bench.truth.tip.front().size());
    report.frames = problem.frames;
    report.fps = problem.fps;
    report.height = bench.height;
    report.rms_deflection = bench.rms;
    report.peak_deflection = bench.peak;
    std::vector<bool> taken(options.variants.size(), false);
    for (std::size_t k = 0; k < options.variants.size(); ++k) {
        if (taken[k]) continue;
        const Variant* in_float = nullptr;
        for (std::size_t j = k; j < options.variants.size(); ++j) {
            const Variant& v = options.variants[j];
            if (!same_series(v, options.variants[k])) continue;
            taken[j] = true;
            if (v.single) in_float = &v;
        }
        std::vector<Variant> in_double;
        for (const double steps : options.steps_per_frame) {
            in_double.push_back(options.variants[k]);
            in_double.back().single = false;
            in_double.back().steps_per_frame = steps;
        }
        bench.series(in_double, in_float);
    }
    bench.find_models();
    return report;
}

} // namespace bough
