#include "file_names.h"
#include "formats/reports/report.h"
#include "formatted.h"
#include "profile.h"
#include <algorithm>
#include <cmath>
#include <memory>

namespace bough {
namespace {

constexpr double least_share = 0.05; // stages below it in the old report are too short to judge by

struct CompareOptions {
    CommonOptions& common;
    std::string old_report, new_report;
    double fail_above = 1.1;
};

void declare_compare(OptionList& list, CompareOptions& o) {
    list.add("OLD", o.old_report, "Report before");
    list.add("NEW", o.new_report, "Report after");
    list.add("--fail-above", o.fail_above, "Ratio new / old above which it exits with 3 (1.1)")
        .takes("X")
        .check(positive_number());
}

void refuse_different(const CompareOptions& o, const Report& before, const Report& after) {
    const auto same = [&](const char* field, const std::string& a, const std::string& b) {
        if (a != b)
            throw InputError(o.new_report,
                             std::string("/") + field + ": is " + b + ", but " + o.old_report + " has " + a);
    };
    same("bodies", std::to_string(before.bodies), std::to_string(after.bodies));
    same("precision", before.precision, after.precision);
    same("solver", before.solver, after.solver);
    same("scheme", before.scheme, after.scheme);
    same("substeps", std::to_string(before.substeps), std::to_string(after.substeps));
}

void note_differences(const Report& before, const Report& after, std::vector<std::string>& notes) {
    const auto note = [&](const char* what, const std::string& a, const std::string& b) {
        if (a != b) notes.push_back(std::string(what) + " differs: " + a + " and " + b);
    };
    note("hash", before.hash, after.hash);
    note("threads", std::to_string(before.threads), std::to_string(after.threads));
    note("frames", std::to_string(before.frames), std::to_string(after.frames));
    note("simd", before.simd, after.simd);
    note("compiler", before.compiler, after.compiler);
    note("flags", before.flags, after.flags);
}

void work_compare(CompareOptions& o) {
    if (o.old_report.empty() || o.new_report.empty())
        throw UsageError("compare: two reports are needed, OLD.json NEW.json");
    refuse_overwriting({{"OLD", o.old_report}, {"NEW", o.new_report}}, {{"-o", o.common.output}});
    require_outputs({{"-o", o.common.output}});
    const Report before = read_report(read_input(o.old_report), input_name(o.old_report));
    const Report after = read_report(read_input(o.new_report), input_name(o.new_report));
    refuse_different(o, before, after);
    note_differences(before, after, o.common.notes);
    std::string text = "stage              old ns   new ns   ratio\n", slower;
    const auto compare = [&](const std::string& name, double a, double b, double share) {
        const double ratio = a > 0 ? b / a : b > 0 ? INFINITY : 1;
        text += formatted("%-15s %9.2f%9.2f%8.3f\n", name.c_str(), a, b, ratio);
        if (share >= least_share && ratio > o.fail_above)
            slower += (slower.empty() ? "" : ", ") + name + formatted(" %.3f", ratio);
    };
    const auto find = [](const Report& report, const std::string& name) {
        const auto found = std::find_if(report.stages.begin(), report.stages.end(),
                                        [&](const ReportStage& s) { return s.name == name; });
        return found == report.stages.end() ? ReportStage{name} : *found;
    };
    for (const ReportStage& s : before.stages)
        compare(s.name, s.ns_per_body_frame, find(after, s.name).ns_per_body_frame, s.share);
    for (const ReportStage& s : after.stages)
        if (find(before, s.name).calls == 0 && s.calls > 0) compare(s.name, 0, s.ns_per_body_frame, 0);
    compare("total", before.total_ns_per_body_frame, after.total_ns_per_body_frame, 1);
    Output output(o.common.output);
    output.write(text);
    output.finish();
    if (!slower.empty())
        throw PromiseError("slower than " + formatted("%g", o.fail_above) + " times before: " + slower);
}

} // namespace

Subcommand profile_compare(CommonOptions& common) {
    const auto o = std::make_shared<CompareOptions>(CompareOptions{common, {}, {}});
    ToolInfo info{
        .name = profile_name,
        .about = "Finds what became slower between two reports of treeprofile.",
        .usage = "treeprofile compare OLD.json NEW.json [--fail-above 1.1]",
        .details =
            "It exits with 3 when the total, or a stage that had at least 5 % of it, costs more than --fail-above "
            "times what it did. Reports of different bodies, precision, solver, scheme or substeps are refused.",
        .examples = "treeprofile compare before.json after.json",
        .formats = {}};
    info.has_source = false;
    return {"compare", info, [o](OptionList& list) { declare_compare(list, *o); }, [o] { work_compare(*o); }};
}

} // namespace bough
