#include "error_plot.h"
#include "report_page.h"
#include <cmath>

namespace bough {
namespace {

PageCell share(double value) {
    return {known(percent(value), value)};
}

PageCell figure_cell(double value) {
    return {known(figure(value), value)};
}

PageCell degrees_cell(double angle) {
    return figure_cell(angle * 180 / M_PI);
}

std::vector<PageCell> cells_of(const ErrorRun& r) {
    std::vector<PageCell> row = {figure_cell(r.seconds_per_simulated_second)};
    for (const double value :
         {r.error_rms, r.error_max, r.error_rms_peak, r.error_max_peak, r.error_rms_height, r.error_max_height})
        row.push_back(r.finite ? share(value) : PageCell{"non-finite"});
    row.push_back(degrees_cell(r.error_angle));
    for (const double value : {r.error_frequency, r.error_decay, r.error_step, r.error_step_max, r.error_model,
                               r.error_model_max, r.error_arithmetic, r.error_arithmetic_max})
        row.push_back(share(value));
    return row;
}

std::vector<PageCell> wood_row(const ErrorRun& r) {
    std::vector<PageCell> row;
    const auto add = [&](const PointError& e) {
        for (const double value : {e.rms, e.max, e.rms_peak, e.max_peak}) row.push_back(share(value));
    };
    add(r.error_wood);
    for (const PointError& level : r.error_level) add(level);
    return row;
}

std::vector<PageCell> motion_row(const MotionSummary& m) {
    std::vector<PageCell> row = {
        figure_cell(m.top.lean), figure_cell(m.top.spread), figure_cell(m.top.peak), {std::to_string(m.still)}};
    for (const double spread : m.level_spread) row.push_back(figure_cell(spread));
    for (int axis = 0; axis < 3; ++axis) row.push_back(degrees_cell(m.leaves.spread[axis]));
    row.push_back(degrees_cell(m.leaves.turn));
    row.push_back(share(m.leaves.fast));
    return row;
}

// Rows under their series' names, the steps a frame before each.
template <class Has, class Figures>
void add_runs(PageTable& table, const ErrorReport& report, const Has& has, const Figures& figures) {
    for (const ErrorSeries& series : error_series(report)) {
        bool named = false;
        for (const ErrorRun* run : series.runs) {
            if (!has(*run)) continue;
            if (!named) table.rows.push_back({{series.name, "head"}});
            named = true;
            table.rows.push_back({{steps_text(run->steps_per_frame)}});
            for (PageCell& cell : figures(*run)) table.rows.back().push_back(std::move(cell));
        }
    }
}

PageTable wood_table(const ErrorReport& report) {
    PageTable table;
    table.names = {"steps/frame"};
    const auto add = [&](const std::string& what) {
        for (const char* name : {" rms", " max", " rms of peak", " max of peak"}) table.names.push_back(what + name);
    };
    add("to level 1");
    for (std::size_t k = 0; k < report.level_deflection.size(); ++k) add("level " + std::to_string(k));
    add_runs(
        table, report, [](const ErrorRun& r) { return r.finite; }, wood_row);
    return table;
}

PageTable motion_table(const ErrorReport& report) {
    PageTable table;
    table.names = {"steps/frame", "top lean m", "top std m", "top peak m", "still frames"};
    for (std::size_t k = 0; k < report.motion.level_spread.size(); ++k)
        table.names.push_back("level " + std::to_string(k) + " std m");
    for (const char* name :
         {"flap std deg", "sway std deg", "twist std deg", "turn deg/frame", "above 30 deg", "spectrum off by"})
        table.names.push_back(name);
    table.rows.push_back({{"truth"}});
    for (PageCell& cell : motion_row(report.motion)) table.rows.back().push_back(std::move(cell));
    table.rows.back().push_back({"-"});
    add_runs(
        table, report, [](const ErrorRun& r) { return r.motion.frames > 0; },
        [](const ErrorRun& r) {
            std::vector<PageCell> row = motion_row(r.motion);
            row.push_back(share(r.error_spectrum));
            return row;
        });
    return table;
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
                    {"held against", report.truth},
                    {"the reference's own error", known(percent(report.reference_error), report.reference_error)},
                    {"the same, max", known(percent(report.reference_error_max), report.reference_error_max)},
                    {"the reference's run time", figure(report.reference_seconds) + " s/s"}};
    page.svg = error_svg(report, output.name());
    page.notes = {
        "Errors are those of the positions of the branches' tips over all frames, as shares of the RMS tip "
        "deflection of the reference, of its peak or of the tree's height. Time is run time per simulated "
        "second. Hollow points, and errors smaller than the reference's own, are not told from zero. Of other "
        "solvers than the first the picture draws one series, the table has all.",
        "Step: from a run to the solver's own limit of small steps; model: from that limit to the full "
        "articulated dynamics; arithmetic: from a run to the same in the widest precision."};
    page.notes.push_back(
        "Wood is compared point by point at its bodies' ends, as shares of the RMS and of the peak of what these ends "
        "move. Leaves and the trunk's top are compared by statistics: std is the standard deviation over time; "
        "spectrum "
        "is the difference of the power of the leaves' normals in bands of 1 Hz, to 15 Hz or half the frame rate.");
    page.table.names = {"steps/frame",   "time s/s",      "rms",           "max",        "rms of peak",   "max of peak",
                        "rms of height", "max of height", "angle rms deg", "frequency",  "decay",         "step",
                        "step max",      "model",         "model max",     "arithmetic", "arithmetic max"};
    add_runs(
        page.table, report, [](const ErrorRun&) { return true; }, cells_of);
    if (std::isfinite(report.wood_deflection.rms)) page.more.push_back({"Wood by branch level", wood_table(report)});
    if (report.motion.frames > 0) page.more.push_back({"Motion", motion_table(report)});
    write_page(output, page, meta);
}

} // namespace bough
