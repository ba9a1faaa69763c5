// report_file.h: --report FILE of `treeprofile error`, `stability` and `scaling`: the file's ending chooses between
// .json, .csv, .svg and .html (in any case). The file appears whole or not at all.
#pragma once
#include "common.h"
#include "formats/reports/error_report.h"
#include "formats/reports/scaling_report.h"
#include "formats/reports/stability_report.h"

namespace bough {

// Before the work whose report it is: throws UsageError for another ending, OutputError where gnuplot is needed and not
// installed. Does nothing for an empty path.
void require_report(const std::string& path);

void write_error_report(const std::string& path, const ErrorReport&, const ReportMeta&);
void write_stability_report(const std::string& path, const StabilityReport&, const ReportMeta&);
void write_scaling_report(const std::string& path, const ScalingReport&, const ReportMeta&);

// What this run of `tool` is made with; source: command lines of the inputs.
ReportMeta report_meta(const char* tool, const CommonOptions&, const std::string& source);

} // namespace bough
