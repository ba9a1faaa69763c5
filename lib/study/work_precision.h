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
// The truth is articulated_reference at a tolerance and at ten times that, or, for trees too large for it, the coupled solver
// at 64 steps a frame and at half of that; what the second is off by from the first is reference_error. Its true error is smaller where it converges;
// where the motion is chaotic (leaves in strong wind), it is what can be said.
// Beside the tips: the wood point by point, at the ends of its bodies, level by level, as shares of what that level's ends
// move; leaves, and the trunk's top, by statistics (motion_statistics.h), the run's beside the truth's.
// Frequencies and decay rates: ring_down.h; in double and up to 8 steps a frame, where they are a solver's own.
#pragma once
#include "trajectory.h"
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

// [m] Of points from where they start: RMS over points and frames, and the largest.
struct Deflection {
    double rms = NAN, peak = NAN;
};

// Of points, [1] as shares of their RMS deflection and of their peak.
struct PointError {
    double rms = NAN, max = NAN, rms_peak = NAN, max_peak = NAN;
};

struct ErrorRun {
    std::string solver, precision;
    // Coupled: scheme.h's names; analytic: inertia-branch or inertia-paper. A solver's default comes first in the report
    std::string scheme;
    double steps_per_frame = 1;                // 1/4 ... 64; below 1 it is frames of that many times the length
    bool finite = false;                       // the whole run; the errors are NAN where it is not
    double seconds_per_simulated_second = NAN; // [s/s] run time of the steps alone
    double error_rms = NAN, error_max = NAN;   // [1] of the RMS tip deflection: over tips and frames, and the worst
    double error_rms_peak = NAN, error_max_peak = NAN;     // [1] the same of the peak tip deflection
    double error_rms_height = NAN, error_max_height = NAN; // [1] of the tree's height
    double error_angle = NAN;                              // [rad] RMS over joints and frames
    double error_frequency = NAN;                          // [1] of the first frequency in a free ring-down
    double error_decay = NAN;                              // [1] of its decay rate
    double error_step = NAN, error_step_max = NAN;   // [1] like error_rms, error_max: from this run to the solver's own
                                                     // limit of small steps
    double error_model = NAN, error_model_max = NAN; // [1] from that limit to the reference
    double error_arithmetic = NAN, error_arithmetic_max = NAN; // [1] from this run to the same in the widest precision
    std::vector<PointError> error_level;                       // wood by branch level
    PointError error_wood;                                     // wood of levels 0 and 1
    MotionSummary motion;                                      // where steps_per_frame >= 1
    double error_spectrum = NAN;                               // [1] of the leaves (spectrum_difference)
    std::string hash;                                          // of the final state
};

struct ErrorReport {
    std::vector<ErrorRun> runs;
    std::string truth = "articulated-reference"; // what all is held against
    double reference_error = NAN; // [1] like error_rms: what the reference says of itself; nothing below it is claimed
    double reference_error_max = NAN;
    std::int64_t bodies = 0, tips = 0, frames = 0;
    double fps = 30;
    double height = 0;                        // [m]
    double rms_deflection = 0;                // [m] of the tips, in the reference
    double peak_deflection = 0;               // [m]
    std::vector<Deflection> level_deflection; // of the wood's ends by branch level, in the reference
    Deflection wood_deflection;               // of levels 0 and 1
    MotionSummary motion;                     // of the reference
    double frequency = NAN;                   // [Hz] first, in a free ring-down of the reference
    double decay = NAN;                       // [1/s] its decay rate
    double reference_seconds = 0;             // [s/s] run time of the reference per simulated second
};

enum class Truth { reference, fine }; // fine: the coupled solver at 64 steps a frame

struct ErrorOptions {
    std::vector<double> steps_per_frame{0.25, 0.5, 1, 2, 4, 8, 16, 32, 64}; // rising powers of two
    std::vector<Variant> variants; // solver, scheme, inertia, precision of the series, in the report's order
    Truth truth = Truth::reference;
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
