#include "converted.h"
#include "file_names.h"
#include "lib/base/caches.h"
#include "lib/study/machine_limits.h"
#include "profile.h"
#include "progress.h"
#include "report_file.h"
#include "scaling.h"
#include "signals.h"
#include "threads.h"
#include <algorithm>
#include <cmath>
#include <memory>

namespace bough {
namespace {

struct ScalingCommand {
    explicit ScalingCommand(CommonOptions& c) : common(c) {}

    CommonOptions& common;
    RunOptions run; // wind
    std::string bodies = "1000,10000,100000,1000000", threads, precision = "float,double",
                solver = solver_name(default_solver), simd = "auto", shape = "bushy";
    std::vector<std::string> trees;
    std::optional<std::int64_t> frames, array;
    int repeat = ScalingChoice().repeat;
    std::string report;
    const OptionList* list = nullptr; // for what was given
};

const std::vector<std::string> shapes = {"bushy", "willow", "chain"};

void declare(OptionList& list, ScalingCommand& o) {
    o.list = &list;
    list.group("Measuring");
    list.add("--bodies", o.bodies, "Sizes, with commas (1000,10000,100000,1000000); trees come within 10 %")
        .takes("LIST");
    list.add("--shape", o.shape,
             "Trees to grow, with commas: bushy (default; apple trees, as many as come to so many bodies), willow, "
             "chain (one\nunbranched pole)")
        .takes("LIST");
    list.add("--tree", o.trees, "A tree of your own instead of grown ones; once for each")
        .takes("FILE")
        .any_number_of_times()
        .check(file_name());
    list.add("--threads", o.threads, "Numbers of threads, with commas (1 and all of the machine)").takes("LIST");
    list.add("--precision", o.precision, "float, double, or both (float,double)").takes("LIST");
    list.add("--solver", o.solver, std::string("Solvers, with commas (") + o.solver + ")").takes("LIST");
    list.add("--simd", o.simd,
             "Which SIMD code, with commas: auto (default), avx512, avx2, baseline, or off, the plain step")
        .takes("LIST");
    list.add("--wind", o.run.wind, "Wind: calm, breeze, gusty, storm, or a bough-wind file").takes("NAME|FILE");
    list.add("--frames", o.frames, "Frames to measure, after one of warm-up (fewer for larger trees: 240 to 4)")
        .takes("N")
        .check(whole_number(1));
    list.add("--repeat", o.repeat, "Rounds, of which the median counts (5)").takes("N").check(whole_number(1, 1000));
    list.add("--array", o.array, "Memory to measure the bandwidth over [MB] (four times the last cache)")
        .takes("MB")
        .check(whole_number(1, 1 << 24));
    list.add("--report", o.report, "Also write the figures as .json or .csv, the plot as .svg, both as .html")
        .takes("FILE")
        .check(file_name());
}

// The parts of a list, each one of `known`, none twice.
std::vector<std::string> words(const std::string& option, const std::string& text,
                               const std::vector<std::string>& known) {
    std::vector<std::string> chosen;
    for (const std::string& word : split_list(text)) {
        if (std::find(known.begin(), known.end(), word) == known.end()) {
            std::string all;
            for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
            throw UsageError(option + " holds '" + word + "', expected some of " + all);
        }
        if (std::find(chosen.begin(), chosen.end(), word) == chosen.end()) chosen.push_back(word);
    }
    return chosen;
}

// Whole numbers from 1 to `most`, rising, none twice.
std::vector<std::int64_t> counts(const std::string& option, const std::string& text, double most) {
    std::vector<std::int64_t> chosen;
    for (const std::string& part : split_list(text)) {
        const double value = number_list(option, part, 1)[0];
        if (!(value >= 1 && value <= most && value == std::floor(value)))
            throw UsageError(option + " holds '" + part + "', expected whole numbers from 1 to " +
                             std::to_string(std::int64_t(most)));
        chosen.push_back(std::int64_t(value));
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
}

std::vector<RunOptions> chosen_ways(const ScalingCommand& o) {
    std::vector<std::string> solvers;
    for (const Solver solver : all_solvers) solvers.push_back(solver_name(solver));
    std::vector<RunOptions> ways;
    for (const std::string& solver : words("--solver", o.solver, solvers))
        for (const std::string& simd : words("--simd", o.simd, {"auto", "off", "baseline", "avx2", "avx512"}))
            for (const std::string& precision : words("--precision", o.precision, {"float", "double"})) {
                RunOptions way;
                way.solver = solver;
                way.simd = simd;
                way.precision = precision;
                if (precision == "float" && solver.rfind("articulated", 0) == 0)
                    throw UsageError("--precision float: not with --solver " + solver + ", which runs in double");
                chosen_simd(way); // refused before the work
                ways.push_back(way);
            }
    return ways;
}

std::vector<ScalingTree> chosen_trees(ScalingCommand& o, const Scene& scene, std::string& source) {
    const auto standing = [&](Tree tree) {
        const TreeRange all{0, tree.size_bodies(), 0};
        Setting setting;
        setting.tree = std::move(tree);
        setting.ranges = {all};
        setting.scene = scene;
        return setting;
    };
    std::vector<ScalingTree> trees;
    for (const std::string& file : o.trees) {
        TreeOfFile read = read_any_tree(file);
        Tree tree = std::move(read.tree);
        o.common.notes.insert(o.common.notes.end(), read.notes.begin(), read.notes.end());
        if (!tree.source.empty()) source += (source.empty() ? "" : "\n") + tree.source;
        trees.push_back({file, standing(std::move(tree))});
        apply_scene(trees.back().setting, file);
    }
    if (!trees.empty()) return trees;
    for (const std::string& shape : words("--shape", o.shape, shapes))
        for (const std::int64_t bodies : counts("--bodies", o.bodies, 2e7))
            trees.push_back({shape, standing(scaling_tree(shape, bodies))});
    return trees;
}

void work(ScalingCommand& o) {
    const auto given = [&](const char* name) { return o.list->given(name); };
    if (!o.trees.empty())
        for (const char* option : {"--bodies", "--shape"})
            if (given(option)) throw UsageError(std::string(option) + ": not with --tree, which says what there is");
    require_outputs({{"-o", o.common.output}, {"--report", o.report}});
    std::vector<NamedFile> read{{"--wind", wind_file(o.run.wind)}};
    for (const std::string& tree : o.trees) read.push_back({"--tree", tree});
    refuse_overwriting(read, {{"--report", o.report}, {"-o", o.common.output}});
    require_report(o.report);
    if (!counts_steps())
        throw UsageError("scaling: this build cannot count what a step computes; make it with -DBOUGH_COUNTING=ON");
    ScalingChoice choice;
    choice.ways = chosen_ways(o);
    const std::string machine = machine_threads() > 1 ? "1," + std::to_string(machine_threads()) : "1";
    for (const std::int64_t n : counts("--threads", o.threads.empty() ? machine : o.threads, most_threads))
        choice.threads.push_back(int(n));
    o.common.threads = choice.threads.back();
    use_threads(o.common.threads);
    if (o.frames) choice.frames = *o.frames;
    choice.repeat = o.repeat;
    choice.array = o.array ? std::size_t(*o.array) << 20 : default_array();
    if (choice.array < 4 * last_cache())
        o.common.notes.push_back(
            "the bandwidth is measured over less than four times the last cache, which may hold a part of it");
    const Scene scene = chosen_scene(o.run);
    std::string source;
    const std::vector<ScalingTree> trees = chosen_trees(o, scene, source);
    refuse_overwriting_the_model({{"--report", o.report}, {"-o", o.common.output}});
    interrupt_at_boundary();
    ScalingReport report;
    {
        std::unique_ptr<Progress> progress;
        report = measure_scaling(trees, choice, [&](std::int64_t done, std::int64_t runs) {
            if (interrupted()) throw Interrupted("interrupted: nothing is written");
            if (!progress) progress = std::make_unique<Progress>(o.common, "run", runs);
            progress->at(done);
        });
    }
    report.wind = o.run.wind;
    Output output(o.common.output);
    output.write(scaling_table(report));
    if (!o.report.empty()) write_scaling_report(o.report, report, report_meta(profile_name, o.common, source));
    output.finish();
}

} // namespace

Subcommand profile_scaling(CommonOptions& common) {
    const auto o = std::make_shared<ScalingCommand>(common);
    ToolInfo info{
        .name = profile_name,
        .about = "Measures ns a body and frame over the number of bodies, beside what the machine can do at most.",
        .usage = "treeprofile scaling [--bodies LIST] [--shape LIST] [--report FILE] ...",
        .details = "It goes through all combinations --repeat times, so that what else the machine does meets all "
                   "alike, and gives the median. It needs a build with -DBOUGH_COUNTING=ON.",
        .examples = "treeprofile scaling --wind gusty --report scaling.html",
        .formats = {}};
    info.has_threads = false;
    info.has_input = false;
    return {"scaling", info, [o](OptionList& list) { declare(list, *o); }, [o] { work(*o); }};
}

} // namespace bough
