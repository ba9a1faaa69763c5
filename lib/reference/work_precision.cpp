#include "work_precision.h"
#include "ring_down.h"
#include <algorithm>
#include <optional>
#include <stdexcept>

namespace bough {
namespace {

constexpr double quick = 0.1;         // [s] below it a run is repeated, the fastest counts
constexpr double ringing_up_to = 8;   // steps a frame
constexpr double reference_cost = 60; // of its passes in a frame, for the progress alone

struct Difference {
    double rms = NAN, worst = NAN; // [m]
};

// Of tips, over the frames that both have (the start is left out).
Difference difference(const Trajectory& a, const Trajectory& b) {
    if (!a.finite || !b.finite) return {};
    const std::int64_t stride = std::max(a.stride, b.stride);
    double squares = 0, worst = 0;
    std::size_t count = 0;
    for (std::int64_t f = stride;; f += stride) {
        const auto i = std::size_t(f / a.stride), j = std::size_t(f / b.stride);
        if (i >= a.tip.size() || j >= b.tip.size()) break;
        for (std::size_t k = 0; k < a.tip[i].size(); ++k) {
            const double d2 = (a.tip[i][k] - b.tip[j][k]).squaredNorm();
            squares += d2;
            worst = std::max(worst, d2);
            ++count;
        }
    }
    if (count == 0) return {};
    return {std::sqrt(squares / double(count)), std::sqrt(worst)};
}

double angle_difference(const Trajectory& run, const Trajectory& truth) {
    if (!run.finite) return NAN;
    double squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 1; i < run.theta.size(); ++i) {
        const std::vector<Vec3>& other = truth.theta[i * std::size_t(run.stride)];
        for (std::size_t k = 0; k < other.size(); ++k) squares += (run.theta[i][k] - other[k]).squaredNorm();
        count += other.size();
    }
    return count > 0 ? std::sqrt(squares / double(count)) : NAN;
}

// Limit of small steps of a first-order solver.
std::optional<Trajectory> limit_of(const Trajectory& coarse, const Trajectory& fine) {
    if (!coarse.finite || !fine.finite || coarse.stride != 1 || fine.stride != 1) return std::nullopt;
    Trajectory limit = fine;
    for (std::size_t f = 0; f < limit.tip.size(); ++f)
        for (std::size_t k = 0; k < limit.tip[f].size(); ++k) limit.tip[f][k] = 2 * fine.tip[f][k] - coarse.tip[f][k];
    return limit;
}

struct Bench {
    const Problem& problem;
    const ErrorOptions& options;
    const std::function<void(std::int64_t, std::int64_t)>& progress;
    double done = 0, total = 1, unit = 1;
    Trajectory truth;
    double height = 0, rms = 0, peak = 0; // [m]
    RingDown ring;
    ErrorReport report;

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
    Trajectory timed(const Variant&);
    ErrorRun row(const Variant&, const Trajectory&, const Trajectory* same_in_double,
                 const std::optional<Trajectory>& limit);
    void series(const std::vector<Variant>& in_double, const Variant* in_float);
};

void Bench::measure_deflection() {
    const std::vector<Vec3>& drawn = truth.tip.front();
    double squares = 0;
    for (std::size_t f = 1; f < truth.tip.size(); ++f)
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            const double d = (truth.tip[f][k] - drawn[k]).norm();
            squares += d * d;
            peak = std::max(peak, d);
        }
    rms = std::sqrt(squares / double(drawn.size() * (truth.tip.size() - 1)));
    double lowest = INFINITY, highest = -INFINITY;
    for (std::size_t i = 0; i < problem.tree.size_bodies(); ++i)
        if (problem.tree.parent[i] < 0) lowest = std::min(lowest, problem.tree.joint_position[i].y());
    for (const Vec3& x : drawn) highest = std::max(highest, x.y());
    height = std::max(highest - lowest, 1e-12);
}

void Bench::find_truth() {
    Variant exact{Solver::articulated_reference, JointInertia::branch, false, 1, options.tolerance};
    start(reference_cost);
    truth = run_trajectory(problem, exact, true, 1, tick());
    if (!truth.finite) throw std::domain_error("the reference solution became non-finite");
    report.reference_seconds = truth.seconds / (double(problem.frames - 1) / problem.fps);
    measure_deflection();
    if (!(rms > 0)) throw std::domain_error("nothing moves in the reference solution: there is no error to measure");
    Variant rough = exact;
    rough.tolerance *= 10;
    const Trajectory again = run_trajectory(problem, rough, false, 1, tick());
    report.reference_error = difference(again, truth).rms / rms;
    if (truth.flags.unresolved > 0) report.reference_error = std::max(report.reference_error, 1.0);
    exact.tolerance = std::max(options.tolerance, 1e-8);
    ring = ring_down(problem, exact, std::min(1 / 120.0, 0.25 / problem.fps), [] {});
    report.frequency = ring.frequency;
    report.decay = ring.decay;
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
    r.scheme = v.solver != Solver::analytic        ? "euler"
               : v.inertia == JointInertia::branch ? "inertia-branch"
                                                   : "inertia-paper";
    r.refresh = "always";
    r.precision = v.single ? "float" : "double";
    r.steps_per_frame = v.steps_per_frame;
    r.finite = run.finite;
    if (!run.finite) return r;
    const double seconds = double(std::int64_t(run.tip.size() - 1) * run.stride) / problem.fps;
    r.seconds_per_simulated_second = run.seconds / seconds;
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(run.hash));
    r.hash = text;
    const Difference error = difference(run, truth);
    r.error_rms = error.rms / rms;
    r.error_max = error.worst / rms;
    r.error_rms_peak = error.rms / peak;
    r.error_max_peak = error.worst / peak;
    r.error_rms_height = error.rms / height;
    r.error_angle = angle_difference(run, truth);
    if (limit) {
        r.error_step = difference(same_in_double ? *same_in_double : run, *limit).rms / rms;
        r.error_model = difference(*limit, truth).rms / rms;
    }
    if (same_in_double) r.error_arithmetic = difference(run, *same_in_double).rms / rms;
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
    if (runs.size() >= 2) limit = limit_of(runs[runs.size() - 2], runs.back());
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const bool shown = std::any_of(options.variants.begin(), options.variants.end(), [&](const Variant& v) {
            return v.solver == variants[k].solver && v.inertia == variants[k].inertia && !v.single;
        });
        if (shown) report.runs.push_back(row(variants[k], runs[k], nullptr, limit));
    }
    if (!in_float) return;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        Variant v = variants[k];
        v.single = true;
        report.runs.push_back(row(v, timed(v), &runs[k], limit));
    }
}

} // namespace

std::vector<Variant> all_variants() {
    return {{Solver::analytic, JointInertia::branch, false},
            {Solver::analytic, JointInertia::branch, true},
            {Solver::analytic, JointInertia::paper, false},
            {Solver::analytic, JointInertia::paper, true},
            {Solver::articulated_implicit, JointInertia::branch, false},
            {Solver::articulated_explicit, JointInertia::branch, false}};
}

ErrorReport measure_error(const Problem& problem, const ErrorOptions& options,
                          const std::function<void(std::int64_t, std::int64_t)>& progress) {
    Bench bench{problem, options, progress, 0, 1, 1, {}, 0, 0, 0, {}, {}};
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
            if (v.solver != options.variants[k].solver || v.inertia != options.variants[k].inertia) continue;
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
    return report;
}

} // namespace bough
