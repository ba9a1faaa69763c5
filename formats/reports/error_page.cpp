#include "error_plot.h"
#include "report_page.h"
#include <cmath>

namespace bough {
namespace {

std::string known(const std::string& text, double value) {
    return std::isfinite(value) ? text : "-";
}

std::vector<PageCell> row_of(const ErrorRun& r) {
    std::vector<PageCell> row = {{steps_text(r.steps_per_frame)},
                                 {known(figure(r.seconds_per_simulated_second), r.seconds_per_simulated_second)}};
    for (const double share : {r.error_rms, r.error_max, r.error_rms_peak, r.error_max_peak, r.error_rms_height})
        row.push_back({r.finite ? known(percent(share), share) : "non-finite"});
    row.push_back({known(figure(r.error_angle * 180 / M_PI), r.error_angle)});
    for (const double share : {r.error_frequency, r.error_decay, r.error_step, r.error_model, r.error_arithmetic})
        row.push_back({known(percent(share), share)});
    return row;
}

} // namespace

void write_error_html(Output& output, const ErrorReport& report, const ReportMeta& meta) {
    Page page;
    page.title = "Error against run time";
    page.summary = {{"bodies", std::to_string(report.bodies)},
                    {"tips", std::to_string(report.tips)},
                    {"frames", std::to_string(report.frames) + " at " + figure(report.fps) + "/s"},
                    {"height", figure(report.height) + " m"},
                    {"RMS tip deflection", figure(report.rms_deflection) + " m"},
                    {"peak tip deflection", figure(report.peak_deflection) + " m"},
                    {"first frequency", known(figure(report.frequency) + " Hz", report.frequency)},
                    {"decay rate", known(figure(report.decay) + " /s", report.decay)},
                    {"the reference's own error", known(percent(report.reference_error), report.reference_error)},
                    {"the reference's run time", figure(report.reference_seconds) + " s/s"}};
    page.svg = error_svg(report, output.name());
    page.notes = {
        "Errors are those of the positions of the branches' tips over all frames, as shares of the RMS tip "
        "deflection of the reference, of its peak or of the tree's height. Time is run time per simulated "
        "second. Hollow points, and errors smaller than the reference's own, are not told from zero. Of other "
        "solvers than the first the picture draws one series, the table has all.",
        "Step: from a run to the solver's own limit of small steps; model: from that limit to the full "
        "articulated dynamics; arithmetic: from a run to the same in the widest precision."};
    page.table.names = {"steps/frame",   "time s/s",  "rms",   "max",  "rms of peak", "max of peak", "rms of height",
                        "angle rms deg", "frequency", "decay", "step", "model",       "arithmetic"};
    for (const ErrorSeries& series : error_series(report)) {
        page.table.rows.push_back({{series.name, "head"}});
        for (const ErrorRun* run : series.runs) page.table.rows.push_back(row_of(*run));
    }
    write_page(output, page, meta);
}

} // namespace bough
