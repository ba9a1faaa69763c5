#include "file_names.h"
#include "lib/study/work_precision.h"
#include "profile.h"
#include "progress.h"
#include "report_file.h"
#include "set_option.h"
#include "signals.h"
#include "simulation.h"
#include <algorithm>
#include <cmath>
#include <memory>

namespace bough {
namespace {

constexpr double error_seconds = 2;

struct ErrorCommand {
    CommonOptions& common;
    RunOptions run;
    std::string steps, report, truth = "reference", joint_inertia = "";
    const OptionList* list = nullptr; // for what was given
};

void declare(OptionList& list, ErrorCommand& o) {
    o.list = &list;
    add_run_options(list, o.run, error_seconds);
    list.group("Measuring");
    list.add("--joint-inertia", o.joint_inertia, "Of the series with the analytic solver, those with this (both)")
        .takes("NAME")
        .one_of({"branch", "paper"});
    list.add("--steps", o.steps,
             "Steps a frame to run with, with commas: powers of two from 1/64 to 4096, the three finest also for the "
             "limit of small steps (1/4,1/2,1,2,4,8,16,32,64)")
        .takes("LIST");
    list.add("--truth", o.truth,
             "What all is held against: articulated-reference, or, for trees of more than some thousand bodies, "
             "the coupled solver at 64 steps a frame (reference)")
        .takes("reference|fine")
        .one_of({"reference", "fine"});
    list.add("--report", o.report, "Also write the figures as .json or .csv, the plot as .svg, both as .html")
        .takes("FILE")
        .check(file_name());
}

// 4, 0.25 or 1/4.
double step_count(const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::string what = "--steps holds '" + text + "', expected powers of two such as 1/4 or 16";
    double value = 0;
    try {
        const auto number = [&](const std::string& part) { return number_list("--steps", part, 1)[0]; };
        value =
            slash == std::string::npos ? number(text) : number(text.substr(0, slash)) / number(text.substr(slash + 1));
    } catch (const UsageError&) {
        throw UsageError(what);
    }
    int exponent = 0;
    if (!(value >= 1.0 / 64 && value <= 4096) || std::frexp(value, &exponent) != 0.5) throw UsageError(what);
    return value;
}

std::vector<double> chosen_steps(const std::string& text) {
    std::vector<double> steps;
    for (const std::string& part : split_list(text)) steps.push_back(step_count(part));
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

// The usual series, or with --scheme that one's; of these what --solver, --precision, --joint-inertia leave.
std::vector<Variant> chosen_variants(const ErrorCommand& o) {
    const auto given = [&](const char* name) { return o.list->given(name); };
    std::vector<Variant> series = all_variants(), chosen;
    if (!o.run.scheme.empty()) {
        Variant v;
        v.solver = Solver::coupled;
        v.scheme = chosen_scheme(o.run);
        series = {v, v};
        series.back().single = true;
    }
    for (const Variant& v : series) {
        if (given("--solver") && o.run.solver != solver_name(v.solver)) continue;
        if (given("--precision") && (o.run.precision == "float") != v.single) continue;
        const bool paper = v.inertia == JointInertia::paper;
        if (!o.joint_inertia.empty() && (v.solver != Solver::analytic || paper != (o.joint_inertia == "paper")))
            continue;
        chosen.push_back(v);
    }
    if (chosen.empty())
        throw UsageError("--solver, --scheme, --precision and --joint-inertia leave nothing to measure");
    return chosen;
}

// A drawn tree that nothing moves stands still: what is measured then is its fall from the unloaded pose.
void let_move(ErrorCommand& o, Scene& scene) {
    if (!stands_still(scene) || scene.pose != Pose::drawn) return;
    if (sets_field(o.run.set, "pose"))
        throw UsageError("--set pose=drawn: nothing moves then; name a wind, or leave it out to switch gravity on");
    scene.pose = Pose::rest;
    o.common.notes.push_back("no wind, pulls or root motion: gravity is switched on at the start (pose rest)");
}

// Series of a solver that cannot hold what the scene names, where nobody asked for it.
void leave_out_analytic(ErrorCommand& o, const Scene& scene, std::vector<Variant>& variants) {
    if (o.list->given("--solver")) return;
    try {
        refuse(Solver::analytic, scene);
    } catch (const std::domain_error& error) {
        std::erase_if(variants, [](const Variant& v) { return v.solver == Solver::analytic; });
        o.common.notes.push_back("solver analytic is left out: " + std::string(error.what()));
    }
}

void work(ErrorCommand& o) {
    if (o.list->given("--substeps")) throw UsageError("--substeps: --steps says it here");
    if (o.truth == "fine" && o.run.tolerance)
        throw UsageError("--tolerance: is the reference's, which --truth fine does without");
    if (sets_field(o.run.set, "joint_limit"))
        throw UsageError("--set joint_limit: the reference solution keeps no limits");
    if (sets_field(o.run.set, "joint_inertia"))
        throw UsageError("--set joint_inertia: --joint-inertia chooses among the series here");
    if (o.run.solver == solver_name(Solver::articulated_reference))
        throw UsageError("--solver articulated-reference is what the others are held against");
    require_outputs({{"-o", o.common.output}, {"--report", o.report}});
    const std::vector<NamedFile> written{{"--report", o.report}, {"-o", o.common.output}};
    refuse_overwriting({{"INPUT", o.run.input}, {"--wind", wind_file(o.run.wind)}}, written);
    require_report(o.report);
    ErrorOptions options;
    if (o.list->given("--steps")) options.steps_per_frame = chosen_steps(o.steps);
    options.variants = chosen_variants(o);
    options.truth = o.truth == "fine" ? Truth::fine : Truth::reference;
    if (options.truth == Truth::fine) {
        constexpr double fine = 64; // the truth itself
        if (o.list->given("--steps") && options.steps_per_frame.back() >= fine)
            throw UsageError("--steps: --truth fine is 64 steps a frame, which tells nothing of as many or more; "
                             "name fewer, or leave --truth out");
        std::erase_if(options.steps_per_frame, [](double steps) { return steps >= fine; });
    }
    if (o.run.tolerance) options.tolerance = *o.run.tolerance;
    RunOptions reading = o.run; // what is a series' own is not the scene's
    reading.tolerance.reset();
    reading.scheme.clear();
    Setting setting = read_setting(reading);
    refuse_overwriting_trees(setting, written);
    o.common.notes.insert(o.common.notes.end(), setting.notes.begin(), setting.notes.end());
    if (has_free_bodies(setting.scene))
        throw InputError(input_name(o.run.input),
                         free_part(setting.scene) + std::string(": treeprofile error has no reference "
                                                                "solution of free bodies and walkers"));
    leave_out_analytic(o, setting.scene, options.variants);
    let_move(o, setting.scene);
    const Problem problem{setting.tree,      setting.ranges, setting.scene, o.run.fps, frames_of(o.run, error_seconds),
                          chosen_simd(o.run)};
    const double coarsest = std::max(1.0, 1 / options.steps_per_frame.front());
    if (double(problem.frames - 1) < 2 * coarsest)
        throw UsageError("--frames: is " + std::to_string(problem.frames) + ", expected at least " +
                         std::to_string(std::int64_t(std::ceil(2 * coarsest)) + 1) +
                         ": two of the longest steps, and the frame at the start");
    interrupt_at_boundary();
    ErrorReport report;
    {
        Progress progress(o.common, "thousandth", 1000);
        try {
            report = measure_error(problem, options, [&](std::int64_t done, std::int64_t) {
                if (interrupted()) throw Interrupted("interrupted: nothing is written");
                progress.at(done);
            });
        } catch (const std::out_of_range& error) {
            throw InputError(input_name(o.run.input), error.what());
        } catch (const std::domain_error& error) {
            throw InputError(input_name(o.run.input), error.what());
        }
    }
    Output output(o.common.output);
    output.write(error_table(report));
    if (!o.report.empty()) write_error_report(o.report, report, report_meta(profile_name, o.common, setting.source));
    output.finish();
}

} // namespace

Subcommand profile_error(CommonOptions& common) {
    const auto o = std::make_shared<ErrorCommand>(ErrorCommand{common, {}, {}, {}});
    ToolInfo info{.name = profile_name,
                  .about = "Measures error against run time, of each solver at each number of steps a frame.",
                  .usage = "treeprofile error TREE|SCENE [--steps LIST] [--report FILE] ...",
                  .details = "All is held against a reference solution of the full articulated dynamics, or with "
                             "--truth fine against the coupled solver at 64 steps a frame, for trees of more than some "
                             "hundred bodies.\n--solver, --scheme, --precision and --joint-inertia choose among the "
                             "series. A tree without wind is let go from its unloaded pose.",
                  .examples = "treeprofile error bare.json --wind gusty --report error.svg",
                  .formats = {},
                  .first = {"INPUT", "--set", "--wind", "--seed", "--seconds", "--frames", "--steps", "--truth",
                            "--solver", "--scheme", "--precision", "--report", "--threads"}};
    return {"error", info, [o](OptionList& list) { declare(list, *o); }, [o] { work(*o); }};
}

} // namespace bough
