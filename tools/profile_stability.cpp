#include "file_names.h"
#include "lib/study/stability.h"
#include "profile.h"
#include "progress.h"
#include "report_file.h"
#include "signals.h"
#include "simulation.h"
#include <memory>

namespace bough {
namespace {

struct StabilityCommand {
    CommonOptions& common;
    RunOptions run;
    std::string only, report;
    std::int64_t frames = StabilityOptions().frames;
};

void declare(OptionList& list, StabilityCommand& o) {
    list.add("INPUT", o.run.input, "A tree, or a scene whose trees, gravity and air are taken; - for stdin");
    list.group("Measuring");
    list.add("--frames", o.frames, "Steps a cell (100)").takes("N").check(whole_number(4));
    add_simd_option(list, o.run);
    list.group("Measuring");
    list.add("--only", o.only, "Only the cases whose group or name contains this").takes("TEXT");
    list.add("--report", o.report, "Also write the figures as .json or .csv, the grid as .svg, both as .html")
        .takes("FILE")
        .check(file_name());
}

void work(StabilityCommand& o) {
    require_outputs({{"-o", o.common.output}, {"--report", o.report}});
    const std::vector<NamedFile> written{{"--report", o.report}, {"-o", o.common.output}};
    refuse_overwriting({{"INPUT", o.run.input}}, written);
    require_report(o.report);
    const Setting setting = read_setting(o.run);
    o.common.notes.insert(o.common.notes.end(), setting.notes.begin(), setting.notes.end());
    refuse_overwriting_trees(setting, written);
    StabilityOptions options;
    options.frames = o.frames;
    options.only = o.only;
    interrupt_at_boundary();
    StabilityReport report;
    {
        std::unique_ptr<Progress> progress;
        report = measure_stability({setting.tree, setting.ranges, setting.scene, 1.0 / 30, chosen_simd(o.run)}, options,
                                   [&](std::int64_t done, std::int64_t cells) {
                                       if (interrupted()) throw Interrupted("interrupted: nothing is written");
                                       if (!progress) progress = std::make_unique<Progress>(o.common, "cell", cells);
                                       progress->at(done);
                                   });
    }
    if (report.cells.empty()) throw UsageError("--only is '" + o.only + "', which no case's group or name contains");
    Output output(o.common.output);
    output.write(stability_table(report));
    if (!o.report.empty())
        write_stability_report(o.report, report, report_meta(profile_name, o.common, setting.source));
    output.finish();
    const PromiseCount count = promise_count(report);
    if (count.held < count.promised)
        throw PromiseError(std::to_string(count.promised - count.held) + " of " + std::to_string(count.promised) +
                           " promised cells do not hold");
}

} // namespace

Subcommand profile_stability(CommonOptions& common) {
    const auto o = std::make_shared<StabilityCommand>(StabilityCommand{common, {}, {}, {}});
    ToolInfo info{.name = profile_name,
                  .about =
                      "Runs a grid of extreme cases, and says of each whether it stayed bounded and moved rightly.",
                  .usage = "treeprofile stability TREE|SCENE [--only TEXT] [--report FILE]",
                  .details = "It exits with 3 where a cell that bough promises does not hold.",
                  .examples = "treeprofile stability oak.tree.json --only wind --report stability.html",
                  .formats = {}};
    return {"stability", info, [o](OptionList& list) { declare(list, *o); }, [o] { work(*o); }};
}

} // namespace bough
