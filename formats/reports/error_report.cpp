#include "error_report.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

void add_shares(ReportRow& row, const std::string& name, const PointError& e) {
    row.insert(row.end(), {{name + "_rms", e.rms},
                           {name + "_max", e.max},
                           {name + "_rms_peak", e.rms_peak},
                           {name + "_max_peak", e.max_peak}});
}

std::string level_name(std::size_t level) {
    return "level" + std::to_string(level);
}

// What a report's rows have columns for, whatever a run of it has: a run that was not finite has none of them.
struct Columns {
    std::size_t levels, bands;
};

Columns columns_of(const ErrorReport& report) {
    return {report.level_deflection.size(), report.motion.leaves.spectrum.size()};
}

double at(const std::vector<double>& values, std::size_t k) {
    return k < values.size() ? values[k] : NAN;
}

// A run's statistics, or with a prefix the truth's.
void add_motion(ReportRow& row, const std::string& prefix, const MotionSummary& m, const Columns& columns) {
    const auto add = [&](const std::string& name, double value) { row.push_back({prefix + name, value}); };
    add("top_lean", m.top.lean);
    add("top_std", m.top.spread);
    add("top_peak", m.top.peak);
    add("still_frames", m.frames > 0 ? double(m.still) : NAN);
    add("last_rate", m.last_rate);
    for (std::size_t k = 0; k < columns.levels; ++k) add(level_name(k) + "_std", at(m.level_spread, k));
    add("leaf_flap_std", m.leaves.spread.x());
    add("leaf_sway_std", m.leaves.spread.y());
    add("leaf_twist_std", m.leaves.spread.z());
    add("leaf_turn", m.leaves.turn);
    add("leaf_fast", m.leaves.fast);
    for (std::size_t k = 0; k < columns.bands; ++k) add("leaf_spectrum" + std::to_string(k), at(m.leaves.spectrum, k));
}

ReportRow row_of(const ErrorRun& r, const Columns& columns) {
    ReportRow row = {{"solver", r.solver},
                     {"scheme", r.scheme},
                     {"steps_per_frame", r.steps_per_frame},
                     {"precision", r.precision},
                     {"finite", r.finite},
                     {"seconds_per_simulated_second", r.seconds_per_simulated_second},
                     {"error_rms", r.error_rms},
                     {"error_max", r.error_max},
                     {"error_rms_peak", r.error_rms_peak},
                     {"error_max_peak", r.error_max_peak},
                     {"error_rms_height", r.error_rms_height},
                     {"error_max_height", r.error_max_height},
                     {"error_angle", r.error_angle},
                     {"error_frequency", r.error_frequency},
                     {"error_decay", r.error_decay},
                     {"error_step", r.error_step},
                     {"error_step_max", r.error_step_max},
                     {"error_model", r.error_model},
                     {"error_model_max", r.error_model_max},
                     {"error_arithmetic", r.error_arithmetic},
                     {"error_arithmetic_max", r.error_arithmetic_max},
                     {"hash", r.hash}};
    add_shares(row, "error_wood", r.error_wood);
    for (std::size_t k = 0; k < columns.levels; ++k)
        add_shares(row, "error_" + level_name(k), k < r.error_level.size() ? r.error_level[k] : PointError{});
    row.push_back({"error_spectrum", r.error_spectrum});
    add_motion(row, "", r.motion, columns);
    return row;
}

std::vector<ReportRow> rows_of(const ErrorReport& report) {
    std::vector<ReportRow> rows;
    for (const ErrorRun& run : report.runs) rows.push_back(row_of(run, columns_of(report)));
    return rows;
}

} // namespace

void write_error_json(Output& output, const ErrorReport& report, const ReportMeta& meta) {
    ReportRow head = {{"bodies", report.bodies},
                      {"tips", report.tips},
                      {"frames", report.frames},
                      {"fps", report.fps},
                      {"height", report.height},
                      {"rms_deflection", report.rms_deflection},
                      {"peak_deflection", report.peak_deflection},
                      {"frequency", report.frequency},
                      {"decay", report.decay},
                      {"truth", report.truth},
                      {"reference_seconds", report.reference_seconds},
                      {"reference_error", report.reference_error},
                      {"reference_error_max", report.reference_error_max}};
    const auto add = [&](const std::string& name, const Deflection& d) {
        head.insert(head.end(), {{name + "_rms_deflection", d.rms}, {name + "_peak_deflection", d.peak}});
    };
    add("wood", report.wood_deflection);
    for (std::size_t k = 0; k < report.level_deflection.size(); ++k) add(level_name(k), report.level_deflection[k]);
    add_motion(head, "truth_", report.motion, columns_of(report));
    write_rows_json(output, "bough-error-report", meta, head, "runs", rows_of(report));
}

void write_error_csv(Output& output, const ErrorReport& report) {
    write_rows_csv(output, row_of(ErrorRun(), columns_of(report)), rows_of(report));
}

std::vector<ErrorSeries> error_series(const ErrorReport& report) {
    std::vector<ErrorSeries> series;
    for (const ErrorRun& run : report.runs) {
        std::string method = run.solver;
        if (!run.scheme.empty()) method += ", " + run.scheme;
        auto found = std::find_if(series.begin(), series.end(), [&](const ErrorSeries& s) {
            const ErrorRun& other = *s.runs.front();
            return other.solver == run.solver && other.scheme == run.scheme && other.precision == run.precision;
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
