#include "report_page.h"
#include "scaling_report.h"

namespace bough {
namespace {

std::string in_unit(double value, double unit = 1) {
    return known(figure(value / unit), value);
}

} // namespace

void write_scaling_html(Output& output, const ScalingReport& report, const ReportMeta& meta) {
    Page page;
    page.title = "Time a body and frame over the number of bodies";
    page.summary = {{"wind", report.wind.empty() ? "none" : report.wind},
                    {"runs of each, interleaved", std::to_string(report.repeat)}};
    for (const ScalingLimits& l : report.limits) {
        const std::string which = l.simd + ", " + std::to_string(l.threads) + (l.threads == 1 ? " thread" : " threads");
        page.summary.emplace_back("memory read, write, copy: " + which, in_unit(l.read, 1e9) + ", " +
                                                                            in_unit(l.write, 1e9) + ", " +
                                                                            in_unit(l.copy, 1e9) + " GB/s");
        page.summary.emplace_back("peak float, double: " + which,
                                  in_unit(l.peak_float, 1e9) + ", " + in_unit(l.peak_double, 1e9) + " Gop/s");
    }
    page.svg = scaling_svg(report, output.name());
    page.notes = {"The limit is the longer of two times: the bytes that a step moves at the fastest of read, write and "
                  "copy, and its operations at the "
                  "peak of multiply-adds. Both are counted (the JSON report has them), and the machine's figures are "
                  "of the same run.",
                  "Memory a body is the slope of peak resident memory from the next smaller size."};
    page.table.names = {"bodies", "frames", "ns", "least", "most", "limit ns", "x limit", "by", "B/body", "hash"};
    for (const ScalingSeries& series : scaling_series(report)) {
        page.table.rows.push_back({{series.name, "head"}});
        for (const ScalingRun* r : series.runs)
            page.table.rows.push_back({{std::to_string(r->bodies)},
                                       {std::to_string(r->frames)},
                                       {in_unit(r->ns)},
                                       {in_unit(r->ns_least)},
                                       {in_unit(r->ns_most)},
                                       {in_unit(r->limit_ns)},
                                       {in_unit(r->over_limit())},
                                       {r->limited_by.empty() ? "-" : r->limited_by, "text"},
                                       {in_unit(r->memory_slope)},
                                       {r->hash, "text"}});
    }
    write_page(output, page, meta);
}

} // namespace bough
