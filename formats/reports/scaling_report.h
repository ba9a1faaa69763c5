// scaling_report.h: what `treeprofile scaling` writes: the document "bough-scaling-report" (formats/reports/README.md), CSV, and a table.
// Figures a body are means over all bodies; one that was not measured, or that nothing is known to count, is NAN.
#pragma once
#include "lib/study/step_cost.h"
#include "report_rows.h"
#include <cmath>

namespace bough {

// What the machine does at most: medians over the rounds of the run itself.
struct ScalingLimits {
    std::string simd; // the target whose code it was measured with
    int threads = 1;
    double read = NAN, write = NAN, copy = NAN; // [B/s] of memory; copied bytes count twice, read and written
    double peak_float = NAN, peak_double = NAN; // [1/s] operations of multiply-adds, two each
    double bandwidth() const;                   // the fastest of the three
    double peak(const std::string& precision) const;
};

// What a step computes and moves, a body.
struct ScalingCost : StepCost {
    std::string shape, solver, precision, simd;
    std::int64_t bodies = 0;
    double operations() const;
    double bytes() const;
};

// One combination, all its runs.
struct ScalingRun {
    std::string shape, solver, scheme, precision, simd;
    int threads = 1;
    std::int64_t bodies = 0, frames = 0; // measured, after one of warm-up
    double ns = NAN;                     // [ns] a body and frame, the median of the runs
    double ns_least = NAN, ns_most = NAN;
    double limit_ns = NAN;     // [ns] that the machine needs at least for what is computed and moved
    std::string limited_by;    // "memory", "arithmetic", or empty
    double memory = NAN;       // [B] peak of resident memory: of tree, plan, state, and making them; no output
    double memory_slope = NAN; // [B] a body, from the next smaller size of the same series
    std::string hash;
    double over_limit() const { return ns / limit_ns; }
};

struct ScalingReport {
    std::string wind; // as asked for
    int repeat = 1;
    double array = 0, last_cache = 0, core_cache = 0; // [B] what bandwidth is measured over; caches, 0: unknown
    std::vector<ScalingLimits> limits;
    std::vector<ScalingCost> costs;
    std::vector<ScalingRun> runs;
};

// limit_ns and limited_by of a run: the longer of its bytes at the bandwidth and its operations at the peak. Where all tables fit the caches
// of the cores that work, none of their bytes are memory's.
void hold_against_limits(ScalingRun&, const ScalingCost&, const ScalingLimits&, double core_cache);

// Sizes of one shape, solver, scheme, precision, target and number of threads: one line of the plot, in the order of the report's runs.
struct ScalingSeries {
    std::string name;                    // "bushy, coupled, P12, float, avx512, 2 threads"
    std::vector<const ScalingRun*> runs; // by bodies; they point into the report
};
std::vector<ScalingSeries> scaling_series(const ScalingReport&);
// memory_slope of every run that has a smaller one in its series.
void find_memory_slopes(ScalingReport&);

void write_scaling_json(Output&, const ScalingReport&, const ReportMeta&);
void write_scaling_csv(Output&, const ScalingReport&); // one row a run
void write_scaling_html(Output&, const ScalingReport&, const ReportMeta&);
std::string scaling_table(const ScalingReport&); // for people, at most 120 columns

// <svg> of ns a body and frame over bodies, one line a series, and the limits as thin lines. `name`: the file that it is for.
std::string scaling_svg(const ScalingReport&, const std::string& name);

} // namespace bough
