#include "stability_report.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

ReportRow row_of(const StabilityCell& c) {
    return {{"group", c.group},
            {"case", c.name},
            {"solver", c.solver},
            {"precision", c.precision},
            {"finite", c.finite},
            {"bounded", c.bounded},
            {"compared", c.compared},
            {"moves", c.moves},
            {"energy_drift", c.energy_drift},
            {"ringing", c.ringing},
            {"max_angle", c.max_angle},
            {"rms_growth", c.rms_growth},
            {"lean_error", c.lean_error},
            {"std_error", c.spread_error},
            {"still_frames", c.compared ? double(c.still) : NAN},
            {"guards", std::int64_t(c.guards)},
            {"promised", c.promised},
            {"outside", c.outside},
            {"frames", c.frames},
            {"note", c.note}};
}

std::vector<ReportRow> rows_of(const StabilityReport& report) {
    std::vector<ReportRow> rows;
    for (const StabilityCell& cell : report.cells) rows.push_back(row_of(cell));
    return rows;
}

bool holds(const StabilityCell& c) {
    return c.frames > 0 && c.finite && c.bounded && c.moves;
}

} // namespace

CellState cell_state(const StabilityCell& c) {
    if (c.frames == 0) return CellState::not_run;
    if (c.outside && !c.promised) return CellState::outside;
    return holds(c) ? CellState::held : CellState::failed;
}

std::string cell_verdict(const StabilityCell& c) {
    const CellState state = cell_state(c);
    if (state == CellState::not_run) return "not run";
    const std::string what = !c.finite ? "non-finite" : !c.bounded ? "unbounded" : !c.moves ? "moves wrongly" : "held";
    if (state != CellState::outside) return what;
    return c.finite && c.bounded && c.moves ? "outside" : "outside, " + what;
}

PromiseCount promise_count(const StabilityReport& report) {
    PromiseCount count;
    for (const StabilityCell& cell : report.cells) {
        count.promised += cell.promised;
        count.held += cell.promised && holds(cell);
    }
    return count;
}

std::string promise_text(const StabilityReport& report) {
    const PromiseCount count = promise_count(report);
    return "promised " + std::to_string(count.held) + " of " + std::to_string(count.promised) + " hold";
}

void write_stability_json(Output& output, const StabilityReport& report, const ReportMeta& meta) {
    const PromiseCount count = promise_count(report);
    const ReportRow head = {
        {"bodies", report.bodies}, {"fps", report.fps}, {"promised", count.promised}, {"promised_held", count.held}};
    write_rows_json(output, "bough-stability-report", meta, head, "cells", rows_of(report));
}

void write_stability_csv(Output& output, const StabilityReport& report) {
    write_rows_csv(output, row_of(StabilityCell()), rows_of(report));
}

std::vector<std::string> stability_groups(const StabilityReport& report) {
    std::vector<std::string> groups;
    for (const StabilityCell& cell : report.cells)
        if (std::find(groups.begin(), groups.end(), cell.group) == groups.end()) groups.push_back(cell.group);
    return groups;
}

} // namespace bough
