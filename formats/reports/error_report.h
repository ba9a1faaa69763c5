// error_report.h: what `treeprofile error` writes: the document "bough-error-report" (formats/reports/README.md), CSV, and a table.
#pragma once
#include "lib/study/work_precision.h"
#include "report_rows.h"

namespace bough {

void write_error_json(Output&, const ErrorReport&, const ReportMeta&);
void write_error_csv(Output&, const ErrorReport&); // one row a run

// For people, at most 120 columns: a summary, then under the name of each way of running a row a run. Shares as
// percentages; a run that became non-finite says so; "-" is a figure that was not measured.
std::string error_table(const ErrorReport&);

// Runs that differ in their steps a frame only, in the report's order: one line of a plot.
struct ErrorSeries {
    std::string name;   // "analytic, inertia-branch, double"
    std::string method; // the name without the precision
    std::string precision;
    std::vector<const ErrorRun*> runs; // by steps a frame, fewest first; they point into the report
};
std::vector<ErrorSeries> error_series(const ErrorReport&);

} // namespace bough
