#include "report_page.h"
#include "stability_plot.h"
#include <cmath>

namespace bough {
namespace {

const char* mark_of(CellState state) {
    switch (state) {
    case CellState::held:
        return "held";
    case CellState::outside:
        return "outside";
    case CellState::failed:
        return "failed";
    case CellState::not_run:
        break;
    }
    return "not-run";
}

std::vector<PageCell> cells_of(const StabilityCell& c) {
    const double degrees = c.max_angle * 180 / M_PI;
    return {{c.name, "text"},
            {c.solver, "text"},
            {c.precision, "text"},
            {c.promised ? "promised" : "", "text"},
            {cell_verdict(c), mark_of(cell_state(c))},
            {known(percent(c.energy_drift), c.energy_drift)},
            {known(figure(c.ringing), c.ringing)},
            {known(figure(degrees), degrees)},
            {known(figure(c.rms_growth), c.rms_growth)},
            {known(percent(c.lean_error), c.lean_error)},
            {known(percent(c.spread_error), c.spread_error)},
            {c.compared ? std::to_string(c.still) : "-"},
            {std::to_string(c.guards)},
            {std::to_string(c.frames)},
            {c.note, "note"}};
}

} // namespace

void write_stability_html(Output& output, const StabilityReport& report, const ReportMeta& meta) {
    const PromiseCount count = promise_count(report);
    Page page;
    page.title = "Stability";
    page.summary = {{"bodies", std::to_string(report.bodies)},
                    {"frames a second", figure(report.fps)},
                    {"cells", std::to_string(report.cells.size())},
                    {"promised cells that hold", std::to_string(count.held) + " of " + std::to_string(count.promised)}};
    page.svg = stability_svg(report, output.name());
    page.notes = {
        "A cell holds if it stayed finite and bounded: energy at most what it began with and what the forces "
        "put in, plus 1 %; joint angles well below 180 degrees; and the last quarter's RMS at most 1.05 times "
        "the third's. Ringing is in sign changes of velocity a frame.",
        "In the cases of a wind the coupled solver's one step a frame is held against 64: lean and std are what the "
        "mean and the standard deviation of the trunk's top are off by. Both are to be within 25 %, and in a wind that "
        "changes no frame may be still."};
    page.table.names = {"case",         "solver",       "precision",     "promise",    "verdict",
                        "energy drift", "ringing",      "max angle deg", "rms growth", "lean",
                        "std",          "still frames", "guards",        "frames",     "note"};
    for (const std::string& group : stability_groups(report)) {
        page.table.rows.push_back({{group, "head"}});
        for (const StabilityCell& cell : report.cells)
            if (cell.group == group) page.table.rows.push_back(cells_of(cell));
    }
    write_page(output, page, meta);
}

} // namespace bough
