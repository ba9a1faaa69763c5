// stability_plot.h: pictures of a StabilityReport, drawn by gnuplot.
#pragma once
#include "stability_report.h"

namespace bough {

// SVG: the grid, a row a case under its group's name, a column a solver and precision; green held, amber outside the
// method's assumption, red failed, grey not run, each also in words; promised cells are framed. `name`: the file it is
// for. Throws OutputError where gnuplot fails.
std::string stability_svg(const StabilityReport&, const std::string& name);

// A page of one file: the grid, the figures, what made it. Loads nothing.
void write_stability_html(Output&, const StabilityReport&, const ReportMeta&);

} // namespace bough
