// treeprofile modes: natural frequencies, their damping and shapes.
#include "file_names.h"
#include "formats/reports/gnuplot.h"
#include "formats/reports/modes_report.h"
#include "frame_sink.h"
#include "lib/laws/wind_field.h"
#include "made_with.h"
#include "profile.h"
#include "progress.h"
#include "report_file.h"
#include "signals.h"
#include "simulation.h"
#include <algorithm>
#include <memory>
#include <numbers>
#include <set>

namespace bough {
namespace {

constexpr int modes_default = 20, branches_default = 8, frames_of_a_swing = 24, shapes_of_a_picture = 6;
constexpr double drawn_amplitude = 1.0 / 12; // [1] of the height
constexpr double seen_to_move = 0.1;         // [1] of that: what a picture of a shape shows apart

struct ModesCommand {
    CommonOptions& common;
    RunOptions run;
    std::string report;
    int modes = modes_default, branches = branches_default;
    std::optional<int> swing;
};

void declare(OptionList& list, ModesCommand& o) {
    list.add("INPUT", o.run.input, "A tree, or a scene whose trees, gravity and wood are taken; - for stdin");
    list.group("Measuring");
    list.add("--modes", o.modes, "How many, from the lowest on (20)").takes("N").check(whole_number(1, 1000));
    list.add("--branches", o.branches,
             "Of each mode's shape, how many branches --report lists, those with most of the energy first (8)")
        .takes("N")
        .check(whole_number(0, 1'000'000));
    list.group("Wind");
    list.add("--wind", o.run.wind,
             "The air's drag at this wind's mean damps as well: a preset or a file, as of treesim (still air)")
        .takes("NAME|FILE");
    list.group("Input");
    list.add("--set", o.run.set, "Changes a value of the scene, as of treesim").takes("PATH=VALUE");
    list.group("Measuring");
    list.add("--swing", o.swing, "With -o FILE.glb: which mode swings there, by a twelfth of the height (1)")
        .takes("K")
        .check(whole_number(1, 1000));
    list.add("--report", o.report, "Also write the figures as .json or .csv, the first six shapes as .svg")
        .takes("FILE")
        .check(file_name());
    name_treeconverts_options(list);
}

ModesReport report_of(const ModesCommand& o, const Setting& setting, const SmallMotion& small,
                      std::vector<NaturalMode> modes) {
    const Tree& tree = setting.tree;
    ModesReport report;
    report.name = tree.name.empty() ? "the tree" : tree.name;
    report.wind = o.run.wind.empty() && setting.scene.wind ? "of the scene" : o.run.wind;
    report.bodies = std::int64_t(tree.size_bodies());
    for (const double mass : tree.mass) report.mass += mass;
    double low = 1e300, high = -1e300;
    const ShapePose standing = swung(small, tree, modes.front(), 0);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        low = std::min(low, standing.position[i].y());
        high = std::max(high, (standing.position[i] + standing.rotation[i] * Vec3(0, 0, tree.size[i][0])).y());
    }
    report.height = high - low;
    for (const NaturalMode& mode : modes) {
        report.branch.push_back(tree.branch[mode.farthest]);
        report.level.push_back(tree.level[mode.farthest]);
        report.moves.push_back(moving_branches(small, tree, mode, std::size_t(o.branches)));
    }
    report.branches = std::int64_t(std::set<std::int32_t>(tree.branch.begin(), tree.branch.end()).size());
    report.modes = std::move(modes);
    return report;
}

// Seen across the mode's widest horizontal way.
DrawnShape drawn(const Setting& setting, const SmallMotion& small, const ModesReport& report, std::size_t k) {
    const Tree& tree = setting.tree;
    const NaturalMode& mode = report.modes[k];
    const double amplitude = drawn_amplitude * report.height;
    const ShapePose rest = swung(small, tree, mode, 0), out = swung(small, tree, mode, amplitude);
    const auto end = [&](const ShapePose& pose, std::size_t i) {
        return Vec3(pose.position[i] + pose.rotation[i] * Vec3(0, 0, tree.size[i][0]));
    };
    Vec3 way = end(out, mode.farthest) - end(rest, mode.farthest);
    way.y() = 0;
    const Vec3 right = way.norm() > 1e-3 * amplitude ? Vec3(way.normalized()) : Vec3(Vec3::UnitX());
    DrawnShape shape;
    shape.title =
        "mode " + std::to_string(k + 1) + ": " + figure(mode.frequency) + " Hz, damping " + percent(mode.damping);
    const auto line = [&](const ShapePose& pose, std::size_t i) {
        const Vec3 a = pose.position[i], b = end(pose, i);
        return DrawnShape::Line{a.dot(right), a.y(), b.dot(right), b.y()};
    };
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        shape.standing.push_back(line(rest, i));
        if ((end(out, i) - end(rest, i)).norm() > seen_to_move * amplitude) shape.swung.push_back(line(out, i));
    }
    return shape;
}

void write_report(const ModesCommand& o, const Setting& setting, const SmallMotion& small, const ModesReport& report) {
    Output file(o.report);
    const std::string end = ending(o.report);
    if (end == ".csv") {
        write_modes_csv(file, report);
    } else if (end == ".json") {
        write_modes_json(file, report, report_meta(profile_name, o.common, setting.source));
    } else {
        std::vector<DrawnShape> shapes;
        for (std::size_t k = 0; k < std::min<std::size_t>(report.modes.size(), shapes_of_a_picture); ++k)
            shapes.push_back(drawn(setting, small, report, k));
        file.write("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" + modes_svg(shapes, o.report));
    }
    file.finish();
}

// One whole swing, first and last frame alike.
void write_swing(ModesCommand& o, const Setting& setting, const SmallMotion& small, const ModesReport& report) {
    const NaturalMode& mode = report.modes[std::size_t(o.swing.value_or(1) - 1)];
    const std::string source = with_command_line(setting.source, o.common);
    const RustleMaker still = [](const Skin&, bool) { return std::unique_ptr<Rustle>(); };
    const double fps = frames_of_a_swing * mode.frequency;
    const std::unique_ptr<FrameSink> sink =
        gltf_sink(o.common.output, setting.tree, 8, still, fps, {}, source, o.common.notes);
    MotionFrame frame;
    for (int k = 0; k <= frames_of_a_swing; ++k) {
        const double phase = 2 * std::numbers::pi * k / frames_of_a_swing;
        const ShapePose pose = swung(small, setting.tree, mode, drawn_amplitude * report.height * std::sin(phase));
        frame.frame = k;
        frame.time = k / fps;
        frame.position = pose.position;
        frame.rotation = pose.rotation;
        sink->write(frame);
    }
    sink->finish();
}

// A table under the name of another format would be read as that format.
void refuse_other_ending(const std::string& output) {
    const std::string end = ending(output);
    if (end == ".json" || end == ".csv" || end == ".svg")
        throw UsageError("-o " + output + ": is where the table goes; --report " + output + " writes a " + end);
    if (!end.empty() && end != ".glb" && end != ".txt" && end != ".tsv")
        throw UsageError("-o is '" + output +
                         "', expected .txt for the table or .glb for a swing; --report writes .json, .csv and .svg");
}

void work(ModesCommand& o) {
    const bool swings = ending(o.common.output) == ".glb";
    refuse_other_ending(o.common.output);
    const std::vector<NamedFile> written{{"--report", o.report}, {"-o", o.common.output}};
    refuse_overwriting({{"INPUT", o.run.input}, {"--wind", wind_file(o.run.wind)}}, written);
    if (const std::string end = ending(o.report); !o.report.empty() && end != ".json" && end != ".csv" && end != ".svg")
        throw UsageError("--report is '" + o.report + "', expected a name that ends in .json, .csv or .svg");
    require_outputs(written);
    if (ending(o.report) == ".svg") require_gnuplot(o.report);
    if (o.swing && !swings) throw UsageError("--swing: only with -o FILE.glb, in which the mode swings");
    const int swing = o.swing.value_or(1);
    if (swing > o.modes)
        throw UsageError("--swing " + std::to_string(swing) + ": of the " + std::to_string(o.modes) +
                         " that --modes asks for");
    Setting setting = read_setting(o.run);
    for (Vec3& K : setting.tree.stiffness) K *= setting.scene.stiffness_scale;
    for (double& beta : setting.tree.damping) beta *= setting.scene.damping_scale;
    o.common.notes.insert(o.common.notes.end(), setting.notes.begin(), setting.notes.end());
    refuse_overwriting_trees(setting, written);
    if (setting.scene.wind && varies_over_ground(*setting.scene.wind))
        throw UsageError(std::string("modes: a wind with ") + parts_over_ground(*setting.scene.wind).front() +
                         " has no one mean that could damp a tree");
    if (!setting.scene.attachments.empty())
        o.common.notes.push_back("modes: the scene's /attachments hold nothing here");
    interrupt_at_boundary();
    ModeOptions options;
    options.count = o.modes;
    options.air = setting.scene.wind || setting.scene.leaves;
    std::vector<NaturalMode> modes;
    std::optional<SmallMotion> standing;
    try {
        standing.emplace(setting.tree, setting.scene.gravity, setting.scene.pose);
        modes = natural_modes(*standing, setting.tree, setting.scene, options, [](std::int64_t) {
            if (interrupted()) throw Interrupted("interrupted: nothing is written");
        });
    } catch (const std::domain_error& error) {
        throw InputError(input_name(o.run.input), error.what());
    }
    const SmallMotion& small = *standing;
    std::set<std::int32_t> buckled;
    for (const std::size_t i : small.buckled()) buckled.insert(setting.tree.branch[i]);
    if (!buckled.empty())
        o.common.notes.push_back("the tree does not stand as drawn: branch " + std::to_string(*buckled.begin()) +
                                 (buckled.size() > 1 ? " and others buckle" : " buckles") +
                                 " under what it carries; modes are of the pose in which it comes to stand; " +
                                 buckling_remedy);
    if (std::size_t(swing) > modes.size())
        throw UsageError("--swing " + std::to_string(swing) + ": the tree has " + std::to_string(modes.size()) +
                         " modes");
    const ModesReport report = report_of(o, setting, small, std::move(modes));
    if (!o.report.empty()) write_report(o, setting, small, report);
    if (swings) {
        write_swing(o, setting, small, report);
        return;
    }
    Output output(o.common.output);
    output.write(modes_table(report));
    output.finish();
}

} // namespace

Subcommand profile_modes(CommonOptions& common) {
    const auto o = std::make_shared<ModesCommand>(ModesCommand{common, {}, {}, modes_default, branches_default, {}});
    ToolInfo info{.name = profile_name,
                  .about = "Finds the lowest natural frequencies, their damping, and which branches move in them.",
                  .usage = "treeprofile modes TREE|SCENE [--modes N] [--wind NAME] [--report FILE]\ntreeprofile modes "
                           "TREE|SCENE --swing K -o FILE.glb",
                  .details = "Frequencies are exact for the rigid bodies, about the pose in which the tree stands, "
                             "gravity in them. With --wind the drag of the air at its mean damps them too. A branch "
                             "that buckles under what it carries is named.",
                  .examples = "treeprofile modes oak.tree.json --wind breeze --report modes.svg\ntreeprofile modes "
                              "oak.tree.json --modes 3 --swing 3 -o swing.glb",
                  .formats = {}};
    return {"modes", info, [o](OptionList& list) { declare(list, *o); }, [o] { work(*o); }};
}

} // namespace bough
