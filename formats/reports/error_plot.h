// error_plot.h: pictures of an ErrorReport, drawn by gnuplot.
#pragma once
#include "error_report.h"

namespace bough {

// SVG: error_rms against run time, both logarithmic, a line for each scheme and precision of the report's first solver and
// for the first of each other solver (what is left out so is named under the legend), its points being steps a frame; the reference's own error as a
// line, points below it drawn on it and hollow; under it the error at one step a frame split into step, model and arithmetic, and its statistics over
// the truth's (float's marks are hollow). Runs that are non-finite, and what cannot be drawn on a logarithmic axis, are named in the legend. `name`:
// the file it is for. Throws OutputError where gnuplot fails.
std::string error_svg(const ErrorReport&, const std::string& name);

// A page of one file: the picture, the figures, what made it. Loads nothing.
void write_error_html(Output&, const ErrorReport&, const ReportMeta&);

} // namespace bough
