#include "file_names.h"
#include "formats/reports/report.h"
#include "formatted.h"
#include "lib/base/hash_text.h"
#include "lib/study/timed_steps.h"
#include "made_with.h"
#include "profile.h"
#include "progress.h"
#include "simulation.h"
#include <algorithm>
#include <filesystem>
#include <memory>

namespace bough {
namespace {

constexpr double stages_seconds = 2;

struct StagesOptions {
    CommonOptions& common;
    RunOptions run;
    std::string report;
    int repeat = 3;
};

void declare_stages(OptionList& list, StagesOptions& o) {
    add_run_options(list, o.run, stages_seconds);
    add_sleep_option(list, o.run);
    list.group("Measuring");
    list.renamed("--joint-inertia", "--set joint_inertia=NAME");
    list.add("--report", o.report, "Also write the figures, as JSON or (by its ending) CSV")
        .takes("FILE")
        .check(file_name());
    list.add("--repeat", o.repeat, "Runs, of which the fastest counts (3)").takes("N").check(whole_number(1, 1000));
}

// One timed run. Times are of the steps alone, from the second frame on.
Report measure(const StagesOptions& o, Simulation& run, std::int64_t frames) {
    StageClock clock;
    begin_again(run);
    advance_frame(run, 1, o.run.substeps);
    const std::vector<StageCalls> before = run.account().stages;
    double total = 0;
    for (std::int64_t f = 2; f < frames; ++f) {
        for (int k = 0; k < o.run.substeps; ++k) total += timed_step(run, &clock);
        require_finite(run, f);
    }
    const RunAccount account = run.account();
    Report report;
    report.bodies = std::int64_t(account.bodies);
    report.frames = frames - 2;
    report.hash = hash_text(run.hash());
    report.simd = account.simd;
    const double ns = 1e9 / double(report.bodies) / double(report.frames);
    double inside = 0;
    const auto add = [&](const char* name, std::uint64_t calls, double seconds) {
        report.stages.push_back({name, std::int64_t(calls), seconds, seconds * ns, total > 0 ? seconds / total : 0});
        inside += seconds;
    };
    for (std::size_t k = 0; k < stage_count; ++k)
        if (const auto& [stage, calls] = account.stages[k]; calls > 0)
            add(stage, calls - before[k].calls, clock.seconds[k]);
    add("other", std::uint64_t(report.frames * o.run.substeps), std::max(0.0, total - inside));
    report.total_ns_per_body_frame = total * ns;
    return report;
}

Report fastest(const StagesOptions& o, const std::shared_ptr<Setting>& setting, std::int64_t frames) {
    Simulation run = started(setting, o.run, o.common.threads, {});
    Progress progress(o.common, "run", o.repeat);
    Report best;
    for (int k = 0; k < o.repeat; ++k) {
        progress.at(k);
        const Report report = measure(o, run, frames);
        if (k > 0 && report.hash != best.hash)
            throw PromiseError("two runs of the same gave hash " + best.hash + " and " + report.hash);
        if (k == 0 || report.total_ns_per_body_frame < best.total_ns_per_body_frame) best = report;
    }
    return best;
}

std::string table(const Report& r) {
    std::string text = "stage                 calls   ns/body/frame   share\n";
    for (const ReportStage& s : r.stages)
        text += formatted("%-18s %8lld   %13.2f  %5.1f%%\n", s.name.c_str(), static_cast<long long>(s.calls),
                          s.ns_per_body_frame, 100 * s.share);
    text += formatted("%-18s %8s   %13.2f  %5.1f%%\n\n", "total", "", r.total_ns_per_body_frame, 100.0);
    text += "bodies " + std::to_string(r.bodies) + ", frames " + std::to_string(r.frames) +
            " (after one of warm-up), substeps " + std::to_string(r.substeps) + "\n";
    text += "hash " + r.hash + "\nthreads " + std::to_string(r.threads) + ", simd " + r.simd + ", " + r.solver +
            (r.scheme.empty() ? "" : ", " + r.scheme) + ", " + r.precision + "\ncompiler " + r.compiler + "\nflags " +
            r.flags + "\n";
    return text;
}

void work_stages(StagesOptions& o) {
    const std::int64_t frames = frames_of(o.run, stages_seconds);
    if (frames < 3) throw UsageError("--frames: at least 3 (the start, a warm-up, and one to measure)");
    if (const std::string end = ending(o.report); end != "" && end != ".json" && end != ".csv")
        throw UsageError("--report is '" + o.report + "', expected a name that ends in .json or .csv");
    require_outputs({{"-o", o.common.output}, {"--report", o.report}});
    const std::vector<NamedFile> written{{"--report", o.report}, {"-o", o.common.output}};
    refuse_overwriting({{"INPUT", o.run.input}, {"--wind", wind_file(o.run.wind)}}, written);
    const auto setting = std::make_shared<Setting>(read_setting(o.run));
    refuse_overwriting_trees(*setting, written);
    o.common.notes.insert(o.common.notes.end(), setting->notes.begin(), setting->notes.end());
    Report report = fastest(o, setting, frames);
    report.tool = profile_name;
    report.version = bough_version();
    report.compiler = compiler_name();
    report.flags = compiler_flags();
    report.solver = o.run.solver;
    report.scheme = scheme_name(o.run);
    report.precision = o.run.precision;
    report.threads = o.common.threads;
    report.substeps = o.run.substeps;
    report.source = with_command_line("", o.common);
    Output output(o.common.output);
    output.write(table(report));
    if (!o.report.empty()) {
        Output file(o.report);
        if (ending(o.report) == ".csv")
            write_report_csv(file, report);
        else
            write_report_json(file, report);
        file.finish();
    }
    output.finish();
}

} // namespace

Subcommand profile_stages(CommonOptions& common) {
    const auto o = std::make_shared<StagesOptions>(StagesOptions{common, {}, {}});
    ToolInfo info{
        .name = profile_name,
        .about =
            "Measures what each stage of a simulation costs; its sub-commands, how wrong it is and what that costs.",
        .usage =
            "treeprofile [stages] TREE|SCENE [--report FILE] [options of treesim]\ntreeprofile error "
            "TREE|SCENE ...      error against run time\ntreeprofile stability TREE|SCENE ...  a grid of extreme "
            "cases\ntreeprofile modes TREE|SCENE ...      natural frequencies and shapes\ntreeprofile scaling ...      "
            "         cost over the number of bodies\ntreeprofile compare OLD.json NEW.json what became slower",
        .details = "stages is what runs unless another of these is the first word; each has its own --help. Nothing is "
                   "written while it measures. The first frame after the start is left out as a warm-up; of --repeat "
                   "runs the fastest counts.",
        .examples =
            "treeprofile oak.tree.json --wind gusty\ntreeprofile oak.tree.json --wind gusty --report before.json",
        .formats = {},
        .first = {"INPUT", "--set", "--wind", "--seed", "--seconds", "--frames", "--fps", "--substeps", "--solver",
                  "--precision", "--report", "--repeat", "--threads"}};
    return {"stages", info, [o](OptionList& list) { declare_stages(list, *o); }, [o] { work_stages(*o); }};
}

} // namespace bough
