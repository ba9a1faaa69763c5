#include "stability_report.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

struct Widths {
    int name = 6, solver = 6;
};

std::string row(const StabilityCell& c, const Widths& w) {
    const double degrees = c.max_angle * 180 / M_PI;
    std::string text = "  " + padded(c.name, -w.name) + "  " + padded(c.solver, -w.solver) + "  " +
                       padded(c.precision, -6) + "  " + (c.promised ? "yes  " : "     ") + padded(cell_verdict(c), -19);
    if (c.frames > 0)
        text += padded(known(percent(c.energy_drift), c.energy_drift), 10) +
                padded(known(figure(c.ringing), c.ringing), 9) + padded(known(figure(degrees), degrees), 9) +
                padded(known(figure(c.rms_growth), c.rms_growth), 9) + padded(std::to_string(c.guards), 8) +
                padded(known(percent(c.lean_error), c.lean_error), 9) +
                padded(known(percent(c.spread_error), c.spread_error), 9);
    while (text.back() == ' ') text.pop_back();
    text += "\n";
    return c.note.empty() ? text : text + "      " + c.note + "\n";
}

} // namespace

std::string stability_table(const StabilityReport& report) {
    Widths w;
    for (const StabilityCell& c : report.cells) {
        w.name = std::max(w.name, int(c.name.size()));
        w.solver = std::max(w.solver, int(c.solver.size()));
    }
    std::string text = "bodies " + std::to_string(report.bodies) + ", frames at " + figure(report.fps) + "/s, cells " +
                       std::to_string(report.cells.size()) + "\n\n  " + padded("case", -w.name) + "  " +
                       padded("solver", -w.solver) + "  prec.   prom." + padded("", -19) + padded("drift", 9) +
                       padded("ringing", 9) + padded("max deg", 9) + padded("growth", 9) + padded("guards", 8) +
                       padded("lean", 9) + padded("std", 9) + "\n";
    for (const std::string& group : stability_groups(report)) {
        text += group + "\n";
        for (const StabilityCell& cell : report.cells)
            if (cell.group == group) text += row(cell, w);
    }
    return text + "\n" + promise_text(report) + "\n";
}

} // namespace bough
