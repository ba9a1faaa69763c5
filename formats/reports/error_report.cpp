#include "error_report.h"
#include <algorithm>
#include <set>

namespace bough {
namespace {

ReportRow row_of(const ErrorRun& r) {
    return {{"solver", r.solver},
            {"scheme", r.scheme},
            {"refresh", r.refresh},
            {"steps_per_frame", r.steps_per_frame},
            {"precision", r.precision},
            {"finite", r.finite},
            {"seconds_per_simulated_second", r.seconds_per_simulated_second},
            {"error_rms", r.error_rms},
            {"error_max", r.error_max},
            {"error_rms_peak", r.error_rms_peak},
            {"error_max_peak", r.error_max_peak},
            {"error_rms_height", r.error_rms_height},
            {"error_angle", r.error_angle},
            {"error_frequency", r.error_frequency},
            {"error_decay", r.error_decay},
            {"error_step", r.error_step},
            {"error_model", r.error_model},
            {"error_arithmetic", r.error_arithmetic},
            {"hash", r.hash}};
}

std::vector<ReportRow> rows_of(const ErrorReport& report) {
    std::vector<ReportRow> rows;
    for (const ErrorRun& run : report.runs) rows.push_back(row_of(run));
    return rows;
}

} // namespace

void write_error_json(Output& output, const ErrorReport& report, const ReportMeta& meta) {
    const ReportRow head = {{"bodies", report.bodies},
                            {"tips", report.tips},
                            {"frames", report.frames},
                            {"fps", report.fps},
                            {"height", report.height},
                            {"rms_deflection", report.rms_deflection},
                            {"peak_deflection", report.peak_deflection},
                            {"frequency", report.frequency},
                            {"decay", report.decay},
                            {"reference_seconds", report.reference_seconds},
                            {"reference_error", report.reference_error}};
    write_rows_json(output, "bough-error-report", meta, head, "runs", rows_of(report));
}

void write_error_csv(Output& output, const ErrorReport& report) {
    write_rows_csv(output, row_of({}), rows_of(report));
}

std::vector<ErrorSeries> error_series(const ErrorReport& report) {
    std::set<std::string> refreshes; // of the solvers that have any
    for (const ErrorRun& run : report.runs)
        if (!run.refresh.empty()) refreshes.insert(run.refresh);
    std::vector<ErrorSeries> series;
    for (const ErrorRun& run : report.runs) {
        std::string method = run.solver;
        if (!run.scheme.empty()) method += ", " + run.scheme;
        if (!run.refresh.empty() && refreshes.size() > 1) method += ", refresh " + run.refresh;
        auto found = std::find_if(series.begin(), series.end(), [&](const ErrorSeries& s) {
            const ErrorRun& other = *s.runs.front();
            return other.solver == run.solver && other.scheme == run.scheme && other.refresh == run.refresh &&
                   other.precision == run.precision;
        });
        if (found == series.end())
            found = series.insert(found, {method + ", " + run.precision, method, run.precision, {}});
        found->runs.push_back(&run);
    }
    for (ErrorSeries& s : series)
        std::stable_sort(s.runs.begin(), s.runs.end(),
                         [](const ErrorRun* a, const ErrorRun* b) { return a->steps_per_frame < b->steps_per_frame; });
    return series;
}

} // namespace bough
