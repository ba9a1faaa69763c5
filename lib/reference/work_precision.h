// work_precision.h: what `treeprofile error` finds: how wrong each way of running a tree is, and what it costs. Errors are
// those of positions of the branches' tips over all frames, against a reference solution of the full articulated
// dynamics; relative ones are shares of the truth's RMS tip deflection |x(t) - x(0)|, unless the name says of what. A
// figure that was not measured, or has no value because the run became non-finite, is NAN.
//
// The split. step: from a run to the solver's own limit of small steps; model: from that limit to the reference; arithmetic:
// from a run in float to the same in double.
// The limit is Richardson's, of the three finest runs in double, each of half the step of the one before: with d1, d2 the RMS
// differences of the first two and of the last two, the observed order is q = log2(d1 / d2), and limit = finest +
// (finest - the one before) / (2^q - 1). q is taken between 1 and 3: the solvers' orders lie there, and what differences near
// rounding say is not believed. Where d2 > 0.75 d1 the runs do not converge and there is no limit.
// What extrapolation leaves is part of the model error: where the order still changes with the step (coupled with stiff joints
// in wind) up to a quarter of the finest run's error. Schemes of one solver share their limit, though: model is that of
// the scheme, of those measured, whose finest run is nearest to its limit.
// The reference is articulated_reference at a tolerance and at ten times that; what the second is off by from the first is
// reference_error. Its true error is smaller where it converges; where the motion is chaotic (leaves in strong wind), it is
// what can be said.
// Frequencies and decay rates: ring_down.h; in double and up to 8 steps a frame, where they are a solver's own.
#pragma once
#include "trajectory.h"
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

struct ErrorRun {
    std::string solver, precision;
    std::string scheme,
        refresh; // coupled: scheme.h's names; analytic: inertia-branch or inertia-paper, and "always" or a tolerance (frozen.h). A
        // solver's default comes first in the report
    double steps_per_frame = 1;                // 1/4 ... 64; below 1 it is frames of that many times the length
    bool finite = false;                       // the whole run; the errors are NAN where it is not
    double seconds_per_simulated_second = NAN; // [s/s] run time of the steps alone
    double error_rms = NAN, error_max = NAN;   // [1] of the RMS tip deflection: over tips and frames, and the worst
    double error_rms_peak = NAN, error_max_peak = NAN; // [1] the same of the peak tip deflection
    double error_rms_height = NAN;                     // [1] of the tree's height
    double error_angle = NAN;                          // [rad] RMS over joints and frames
    double error_frequency = NAN;                      // [1] of the first frequency in a free ring-down
    double error_decay = NAN;                          // [1] of its decay rate
    double error_step = NAN;       // [1] like error_rms: from this run to the solver's own limit of small steps
    double error_model = NAN;      // [1] from that limit to the reference
    double error_arithmetic = NAN; // [1] from this run to the same in the widest precision
    std::string hash;              // of the final state
};

struct ErrorReport {
    std::vector<ErrorRun> runs;
    double reference_error = NAN; // [1] like error_rms: what the reference says of itself; nothing below it is claimed
    std::int64_t bodies = 0, tips = 0, frames = 0;
    double fps = 30;
    double height = 0;            // [m]
    double rms_deflection = 0;    // [m] of the tips, in the reference
    double peak_deflection = 0;   // [m]
    double frequency = NAN;       // [Hz] first, in a free ring-down of the reference
    double decay = NAN;           // [1/s] its decay rate
    double reference_seconds = 0; // [s/s] run time of the reference per simulated second
};

struct ErrorOptions {
    std::vector<double> steps_per_frame{0.25, 0.5, 1, 2, 4, 8, 16, 32, 64}; // rising powers of two
    std::vector<Variant> variants; // solver, scheme, inertia, precision of the series, in the report's order
    double tolerance = 1e-6; // [rad] of the reference: an error of its tips of 1e-6 to 1e-5 of their RMS deflection
};

// The series that are measured unless others are asked for: every solver that exists, each one's default first;
// coupled's default and all of analytic in float too. Of coupled the schemes whose trade differs: P.25 lies between P12 and P.5.
std::vector<Variant> all_variants();

// progress(done, total) in thousandths of the work, once a frame; may throw to end. Cost: sum of the runs; the reference
// takes 36 passes an inner step. Throws what make_plan throws, std::domain_error where nothing moves in the reference.
ErrorReport measure_error(const Problem&, const ErrorOptions&,
                          const std::function<void(std::int64_t, std::int64_t)>& progress);

} // namespace bough
