#include "scaling_report.h"
#include <algorithm>

namespace bough {
namespace {

ReportRow row_of(const ScalingLimits& l) {
    return {{"simd", l.simd},
            {"threads", std::int64_t(l.threads)},
            {"read", l.read},
            {"write", l.write},
            {"copy", l.copy},
            {"peak_float", l.peak_float},
            {"peak_double", l.peak_double}};
}

ReportRow row_of(const ScalingCost& c) {
    return {{"shape", c.shape},
            {"bodies", c.bodies},
            {"solver", c.solver},
            {"precision", c.precision},
            {"simd", c.simd},
            {"slots", c.slots},
            {"additions", c.additions},
            {"multiplications", c.multiplications},
            {"divisions", c.divisions},
            {"roots", c.roots},
            {"constants_in", c.constants_in},
            {"now_in", c.now_in},
            {"next_in", c.next_in},
            {"next_out", c.next_out},
            {"solved_in", c.solved_in},
            {"solved_out", c.solved_out},
            {"records_in", c.records_in},
            {"records_out", c.records_out},
            {"indices_in", c.indices_in},
            {"tables", c.tables},
            {"operations", c.operations()},
            {"bytes", c.bytes()}};
}

ReportRow row_of(const ScalingRun& r) {
    return {{"shape", r.shape},
            {"bodies", r.bodies},
            {"solver", r.solver},
            {"scheme", r.scheme},
            {"precision", r.precision},
            {"simd", r.simd},
            {"threads", std::int64_t(r.threads)},
            {"frames", r.frames},
            {"ns_per_body_frame", r.ns},
            {"ns_least", r.ns_least},
            {"ns_most", r.ns_most},
            {"limit_ns", r.limit_ns},
            {"limited_by", r.limited_by},
            {"over_limit", r.over_limit()},
            {"memory", r.memory},
            {"memory_per_body", r.memory_slope},
            {"hash", r.hash}};
}

template <class X> std::vector<ReportRow> rows_of(const std::vector<X>& all) {
    std::vector<ReportRow> rows;
    for (const X& one : all) rows.push_back(row_of(one));
    return rows;
}

std::string series_name(const ScalingRun& r) {
    return r.shape + ", " + r.solver + (r.scheme.empty() ? "" : ", " + r.scheme) + ", " + r.precision + ", " + r.simd +
           ", " + std::to_string(r.threads) + (r.threads == 1 ? " thread" : " threads");
}

} // namespace

double ScalingLimits::bandwidth() const {
    return std::max({read, write, copy});
}

double ScalingLimits::peak(const std::string& precision) const {
    return precision == "float" ? peak_float : peak_double;
}

double ScalingCost::operations() const {
    return additions + multiplications + divisions + roots;
}

double ScalingCost::bytes() const {
    return constants_in + now_in + next_in + next_out + solved_in + solved_out + records_in + records_out + indices_in;
}

void hold_against_limits(ScalingRun& run, const ScalingCost& cost, const ScalingLimits& limits, double core_cache) {
    const bool cached = cost.tables <= core_cache * run.threads;
    const double memory = cached ? 0 : 1e9 * cost.bytes() / limits.bandwidth();
    const double arithmetic = 1e9 * cost.operations() / limits.peak(run.precision);
    run.limit_ns = NAN;
    run.limited_by.clear();
    if (!std::isfinite(memory) || !std::isfinite(arithmetic)) return;
    run.limit_ns = std::max(memory, arithmetic);
    run.limited_by = memory > arithmetic ? "memory" : "arithmetic";
}

std::vector<ScalingSeries> scaling_series(const ScalingReport& report) {
    std::vector<ScalingSeries> all;
    for (const ScalingRun& run : report.runs) {
        const std::string name = series_name(run);
        auto found = std::find_if(all.begin(), all.end(), [&](const ScalingSeries& s) { return s.name == name; });
        if (found == all.end()) found = all.insert(found, {name, {}});
        found->runs.push_back(&run);
    }
    for (ScalingSeries& s : all)
        std::stable_sort(s.runs.begin(), s.runs.end(),
                         [](const ScalingRun* a, const ScalingRun* b) { return a->bodies < b->bodies; });
    return all;
}

void find_memory_slopes(ScalingReport& report) {
    for (const ScalingSeries& series : scaling_series(report))
        for (std::size_t k = 1; k < series.runs.size(); ++k) {
            const ScalingRun &small = *series.runs[k - 1], &large = *series.runs[k];
            if (large.bodies == small.bodies) continue;
            report.runs[std::size_t(&large - report.runs.data())].memory_slope =
                (large.memory - small.memory) / double(large.bodies - small.bodies);
        }
}

void write_scaling_json(Output& output, const ScalingReport& report, const ReportMeta& meta) {
    const ReportRow head = {{"wind", report.wind},
                            {"repeat", std::int64_t(report.repeat)},
                            {"array", report.array},
                            {"last_cache", report.last_cache},
                            {"core_cache", report.core_cache}};
    write_lists_json(
        output, "bough-scaling-report", meta, head,
        {{"limits", rows_of(report.limits)}, {"costs", rows_of(report.costs)}, {"runs", rows_of(report.runs)}});
}

void write_scaling_csv(Output& output, const ScalingReport& report) {
    write_rows_csv(output, row_of(ScalingRun()), rows_of(report.runs));
}

} // namespace bough
