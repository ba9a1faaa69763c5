// treeprofile: what a run costs, stage by stage, and whether it has become slower.
#include "formats/report.h"
#include "simulation.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <filesystem>

namespace {

using namespace bough;

constexpr double seconds_default = 2;
constexpr double least_share = 0.05; // compare: stages below it in the old report are too short to judge by

struct Options {
    CommonOptions common;
    RunOptions run;
    std::string report;
    int repeat = 3;
    std::string old_report, new_report; // compare
    double fail_above = 1.1;
};

const ToolInfo info = {
    "treeprofile",
    "Measures what each stage of a simulation costs; `compare` finds what became slower.\n"
    "Usage: treeprofile [stages] TREE|SCENE [--report FILE.json|FILE.csv] [treesim's run options]\n"
    "       treeprofile compare OLD.json NEW.json [--fail-above 1.1]",
    "stages is what runs unless compare is the first word. Nothing is written while it measures. The first frame "
    "after\n"
    "the start is left out as a warm-up; of --repeat runs the fastest counts.\n"
    "compare exits with 3 when the total, or a stage that had at least 5 % of it, costs more than --fail-above times\n"
    "what it did. Reports of different bodies, precision, solver or substeps are refused (2).\n"
    "Exit: 0 done, 1 usage, 2 bad input, 3 non-finite or slower, 4 output not written, 130 interrupted.",
    {}};

std::string formatted(const char* format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

void declare_stages(CLI::App& app, Options& o) {
    add_run_options(app, o.run, seconds_default);
    app.add_option("--report", o.report, "Also write the figures, as JSON or (by its ending) CSV")
        ->option_text("FILE")
        ->check(file_name());
    app.add_option("--repeat", o.repeat, "Runs, of which the fastest counts (3)")
        ->option_text("N")
        ->check(whole_number(1, 1000));
}

void declare_compare(CLI::App& app, Options& o) {
    app.add_option("OLD", o.old_report, "Report before");
    app.add_option("NEW", o.new_report, "Report after");
    app.add_option("--fail-above", o.fail_above, "Ratio new / old above which it exits with 3 (1.1)")
        ->option_text("X")
        ->check(positive_number());
}

// One timed run. Times are of the steps alone, from the second frame on.
template <class T> Report measure(const Options& o, const Setting& setting, const Plan<T>& plan, std::int64_t frames) {
    using Time = std::chrono::steady_clock;
    State<T> state = make_state(plan);
    StageClock clock;
    advance_frame(plan, state, setting.tree, 1, o.run.substeps);
    const auto calls_before = state.calls;
    double total = 0;
    for (std::int64_t f = 2; f < frames; ++f) {
        for (int k = 0; k < o.run.substeps; ++k) {
            const Time::time_point start = Time::now();
            step(plan, state, &clock);
            total += std::chrono::duration<double>(Time::now() - start).count();
        }
        require_finite(state, setting.tree, f);
    }
    Report report;
    report.bodies = std::int64_t(plan.bodies);
    report.frames = frames - 2;
    report.hash = hash_text(state_hash(state));
    const double ns = 1e9 / double(report.bodies) / double(report.frames);
    double inside = 0;
    const auto add = [&](const char* name, std::uint64_t calls, double seconds) {
        report.stages.push_back({name, std::int64_t(calls), seconds, seconds * ns, total > 0 ? seconds / total : 0});
        inside += seconds;
    };
    for (std::size_t k = 0; k < stage_count; ++k)
        if (state.calls[k] > 0) add(stage_name(Stage(k)), state.calls[k] - calls_before[k], clock.seconds[k]);
    add("other", std::uint64_t(report.frames * o.run.substeps), std::max(0.0, total - inside));
    report.total_ns_per_body_frame = total * ns;
    return report;
}

template <class T> Report fastest(const Options& o, const Setting& setting, std::int64_t frames) {
    const Plan<T> plan = plan_run<T>(setting, {}, o.run);
    Progress progress(o.common, "run", o.repeat);
    Report best;
    for (int k = 0; k < o.repeat; ++k) {
        progress.at(k);
        const Report report = measure(o, setting, plan, frames);
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
    text += "hash " + r.hash + "\nthreads " + std::to_string(r.threads) + ", simd " + r.simd + ", " + r.solver + ", " +
            r.precision + "\ncompiler " + r.compiler + "\nflags " + r.flags + "\n";
    return text;
}

void work_stages(Options& o) {
    const std::int64_t frames = frames_of(o.run, seconds_default);
    if (frames < 3) throw UsageError("--frames: at least 3 (the start, a warm-up, and one to measure)");
    if (!o.report.empty() && o.report == o.common.output) throw UsageError("--report and -o name the same file");
    const Setting setting = read_setting(o.run);
    Report report =
        o.run.precision == "float" ? fastest<float>(o, setting, frames) : fastest<double>(o, setting, frames);
    report.tool = info.name;
    report.version = bough_version();
    report.compiler = compiler_name();
    report.flags = compiler_flags();
    report.simd = simd_target();
    report.solver = o.run.solver;
    report.precision = o.run.precision;
    report.threads = o.common.threads;
    report.substeps = o.run.substeps;
    report.source = with_command_line("", o.common);
    Output output(o.common.output);
    output.write(table(report));
    if (!o.report.empty()) {
        Output file(o.report);
        if (std::filesystem::path(o.report).extension() == ".csv")
            write_report_csv(file, report);
        else
            write_report_json(file, report);
        file.finish();
    }
    output.finish();
}

void refuse_different(const Options& o, const Report& before, const Report& after) {
    const auto same = [&](const char* field, const std::string& a, const std::string& b) {
        if (a != b)
            throw InputError(o.new_report,
                             std::string("/") + field + ": is " + b + ", but " + o.old_report + " has " + a);
    };
    same("bodies", std::to_string(before.bodies), std::to_string(after.bodies));
    same("precision", before.precision, after.precision);
    same("solver", before.solver, after.solver);
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

void work_compare(Options& o) {
    if (o.old_report.empty() || o.new_report.empty())
        throw UsageError("compare: two reports are needed, OLD.json NEW.json");
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

int main(int argc, char** argv) {
    Options o;
    // The first word chooses what is done; a tree is never called like a subcommand by accident, because ./compare is
    // another word.
    const std::string word = argc > 1 ? argv[1] : "";
    const bool compare = word == "compare";
    std::vector<char*> arguments(argv, argv + argc);
    if (compare || word == "stages") arguments.erase(arguments.begin() + 1);
    ToolInfo own = info;
    own.has_source = !compare;
    return run_tool(
        own, int(arguments.size()), arguments.data(), o.common,
        [&](CLI::App& app) { compare ? declare_compare(app, o) : declare_stages(app, o); },
        [&] { compare ? work_compare(o) : work_stages(o); });
}
