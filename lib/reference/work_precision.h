// work_precision.h: what `treeprofile error` finds: how wrong each way of running a tree is, and what it costs. Errors are
// those of positions of the branches' tips over all frames, against a reference solution of the full articulated
// dynamics; relative ones are shares of the truth's RMS tip deflection |x(t) - x(0)|, unless the name says of what. A
// figure that was not measured, or has no value because the run became non-finite, is NAN.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

struct ErrorRun {
    std::string solver, scheme, refresh, precision; // a solver's default scheme and refresh come first in the report
    double steps_per_frame = 1;                     // 1/4 ... 64; below 1 it is frames of that many times the length
    bool finite = false;                            // the whole run; the errors are NAN where it is not
    double seconds_per_simulated_second = NAN;      // [s/s] run time of the steps alone
    double error_rms = NAN, error_max = NAN; // [1] of the RMS tip deflection: over tips and frames, and the worst
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

} // namespace bough
