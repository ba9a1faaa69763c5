#include "scaling_report.h"

namespace bough {
namespace {

constexpr int column = 10;

std::string cell(double value, double unit = 1) {
    return padded(std::isnan(value) ? "-" : figure(value / unit), column);
}

std::string head_line(std::initializer_list<const char*> names) {
    std::string text;
    for (const char* name : names) text += padded(name, column);
    return text + "\n";
}

std::string size_text(double bytes) {
    return bytes > 0 ? figure(bytes / 1048576) + " MB" : "unknown";
}

std::string limits_text(const ScalingReport& report) {
    std::string text = "Machine: memory over " + size_text(report.array) + " (last cache " +
                       size_text(report.last_cache) + ", a core's " + size_text(report.core_cache) +
                       "), multiply-adds\n" + padded("simd", -column) +
                       head_line({"threads", "read GB/s", "write", "copy", "Gop/s flt", "double"});
    for (const ScalingLimits& l : report.limits)
        text += padded(l.simd, -column) + padded(std::to_string(l.threads), column) + cell(l.read, 1e9) +
                cell(l.write, 1e9) + cell(l.copy, 1e9) + cell(l.peak_float, 1e9) + cell(l.peak_double, 1e9) + "\n";
    return text;
}

std::string costs_text(const ScalingReport& report) {
    std::string text = "\nOperations and bytes a body and step, counted\n" + padded("bodies", column) +
                       head_line({"slots", "add", "multiply", "divide", "root", "const B", "now", "next", "solved",
                                  "records", "all B"});
    std::string before;
    for (const ScalingCost& c : report.costs) {
        const std::string name = c.shape + ", " + c.solver + ", " + c.precision + ", " + c.simd;
        if (name != before) text += name + "\n";
        before = name;
        text += padded(std::to_string(c.bodies), column) + cell(c.slots) + cell(c.additions) + cell(c.multiplications) +
                cell(c.divisions) + cell(c.roots) + cell(c.constants_in) + cell(c.now_in) +
                cell(c.next_in + c.next_out) + cell(c.solved_in + c.solved_out) + cell(c.records_in + c.records_out) +
                cell(c.bytes()) + "\n";
    }
    return text;
}

std::string runs_text(const ScalingReport& report) {
    std::string text =
        "\nns a body and frame, the median of " + std::to_string(report.repeat) +
        (report.repeat == 1 ? " run" : " runs") + "; wind " + (report.wind.empty() ? "none" : report.wind) + "\n" +
        padded("bodies", column) +
        head_line({"frames", "ns", "least", "most", "frames/s", "limit ns", "x limit"}).substr(0, 7 * column) +
        padded("", 2) + padded("by", -column) + padded("B/body", column) + "  hash\n";
    for (const ScalingSeries& series : scaling_series(report)) {
        text += series.name + "\n";
        for (const ScalingRun* r : series.runs)
            text += padded(std::to_string(r->bodies), column) + padded(std::to_string(r->frames), column) +
                    cell(r->ns) + cell(r->ns_least) + cell(r->ns_most) + cell(1e9 / (r->ns * double(r->bodies))) +
                    cell(r->limit_ns) + cell(r->over_limit()) + "  " +
                    padded(r->limited_by.empty() ? "-" : r->limited_by, -column) + cell(r->memory_slope) + "  " +
                    r->hash + "\n";
    }
    return text;
}

} // namespace

std::string scaling_table(const ScalingReport& report) {
    return limits_text(report) + (report.costs.empty() ? "" : costs_text(report)) + runs_text(report);
}

} // namespace bough
