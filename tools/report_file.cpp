#include "report_file.h"
#include "file_names.h"
#include "formats/reports/error_plot.h"
#include "formats/reports/gnuplot.h"
#include "formats/reports/stability_plot.h"
#include "made_with.h"

namespace bough {
namespace {

enum class ReportForm { json, csv, svg, html };

ReportForm form_of(const std::string& path) {
    const std::string end = ending(path);
    if (end == ".json") return ReportForm::json;
    if (end == ".csv") return ReportForm::csv;
    if (end == ".svg") return ReportForm::svg;
    if (end == ".html") return ReportForm::html;
    throw UsageError("--report is '" + path + "', expected a name that ends in .json, .csv, .svg or .html");
}

// The document that stands in a .svg of its own.
std::string svg_file(const std::string& svg) {
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" + svg;
}

} // namespace

void require_report(const std::string& path) {
    if (path.empty()) return;
    const ReportForm form = form_of(path);
    if (form == ReportForm::svg || form == ReportForm::html) require_gnuplot(path);
}

void write_error_report(const std::string& path, const ErrorReport& report, const ReportMeta& meta) {
    const ReportForm form = form_of(path);
    Output file(path);
    switch (form) {
    case ReportForm::json:
        write_error_json(file, report, meta);
        break;
    case ReportForm::csv:
        write_error_csv(file, report);
        break;
    case ReportForm::svg:
        file.write(svg_file(error_svg(report, path)));
        break;
    case ReportForm::html:
        write_error_html(file, report, meta);
        break;
    }
    file.finish();
}

void write_stability_report(const std::string& path, const StabilityReport& report, const ReportMeta& meta) {
    const ReportForm form = form_of(path);
    Output file(path);
    switch (form) {
    case ReportForm::json:
        write_stability_json(file, report, meta);
        break;
    case ReportForm::csv:
        write_stability_csv(file, report);
        break;
    case ReportForm::svg:
        file.write(svg_file(stability_svg(report, path)));
        break;
    case ReportForm::html:
        write_stability_html(file, report, meta);
        break;
    }
    file.finish();
}

void write_scaling_report(const std::string& path, const ScalingReport& report, const ReportMeta& meta) {
    const ReportForm form = form_of(path);
    Output file(path);
    switch (form) {
    case ReportForm::json:
        write_scaling_json(file, report, meta);
        break;
    case ReportForm::csv:
        write_scaling_csv(file, report);
        break;
    case ReportForm::svg:
        file.write(svg_file(scaling_svg(report, path)));
        break;
    case ReportForm::html:
        write_scaling_html(file, report, meta);
        break;
    }
    file.finish();
}

ReportMeta report_meta(const char* tool, const CommonOptions& common, const std::string& source) {
    return {
        tool, bough_version(), compiler_name(), compiler_flags(), common.threads, with_command_line(source, common)};
}

} // namespace bough
