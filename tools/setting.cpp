#include "setting.h"
#include "converted.h"
#include "exits.h"
#include "formats/documents/scene.h"
#include "formats/open.h"
#include "scene_trees.h"
#include "set_option.h"
#include <filesystem>
#include <set>

namespace bough {
namespace {

std::optional<Wind> chosen_wind(const std::string& wind) {
    if (wind.empty()) return std::nullopt;
    if (const std::optional<Wind> preset = wind_preset(wind)) return preset;
    std::error_code none;
    if (wind.find_first_of("./") == std::string::npos && !std::filesystem::exists(wind, none))
        throw UsageError("--wind is '" + wind + "', neither calm, breeze, gusty, storm nor a file");
    return read_wind(read_input(wind), input_name(wind));
}

void apply(const RunOptions& o, const std::optional<Wind>& wind, Scene& scene) {
    if (wind) scene.wind = wind;
    if (o.seed) {
        if (!scene.wind) throw UsageError("--seed: only with a wind, whose turbulence is what it seeds");
        scene.wind->seed = *o.seed;
    }
    if (!o.gravity.empty()) {
        const std::vector<double> g = number_list("--gravity", o.gravity, 3);
        scene.gravity = Vec3(g[0], g[1], g[2]);
    }
}

constexpr const char* empty_scene = R"({"format": "bough-scene", "version": 1})";

// The document with the options applied, and what --set asks for last of all: once in the document itself, which may wait for it to be
// complete, and of fields that other options set too, once more behind these.
SceneDocument chosen_document(const RunOptions& o, std::string_view content, const std::string& name) {
    const std::optional<Wind> wind = chosen_wind(o.wind);
    std::vector<SceneOverride> first = overrides_of(o.set), last;
    for (const SceneOverride& change : first)
        for (const char* field : {"wind", "gravity"})
            if (change.path.front() == field) last.push_back(change);
    if (wind && !first.empty()) first.insert(first.begin(), {"--wind " + o.wind, {"wind"}, wind_text(*wind)});
    SceneDocument document = read_scene_document(content, name, first);
    apply(o, wind, document.scene);
    return last.empty() ? document : changed(document, last);
}

// A park has many trees of few files.
std::vector<std::string> tree_files(const std::string& scene_file, const Scene& scene) {
    std::vector<std::string> files;
    std::set<std::string> known;
    for (const Placement& place : scene.trees)
        if (known.insert(place.file).second) files.push_back(tree_file(scene_file, place));
    return files;
}

} // namespace

void apply_scene(Setting& setting, const std::string& input) {
    try {
        change_wood(setting);
        join_rigid(setting);
    } catch (const SceneError& error) {
        throw InputError(input_name(input), error.what());
    }
}

Setting read_setting(const RunOptions& o) {
    if (o.input.empty()) throw UsageError("INPUT: missing");
    const Solver solver = chosen_solver(o);
    if (is_articulated(solver) && o.precision == "float")
        throw UsageError("--precision float: not with --solver " + o.solver + ", which runs in double");
    if (solver != Solver::analytic && sets_field(o.set, "joint_inertia"))
        throw UsageError("--set joint_inertia: only with --solver analytic");
    if (is_articulated(solver) && sets_field(o.set, "joint_limit"))
        throw UsageError("--set joint_limit: only with --solver coupled or analytic, which keep limits");
    if (solver != Solver::coupled && !o.scheme.empty()) throw UsageError("--scheme: only with --solver coupled");
    if (o.tolerance && solver != Solver::articulated_reference)
        throw UsageError("--tolerance: only with --solver articulated-reference");
    Setting setting;
    const bool foreign = is_converted(o.input); // then it may be large, and its reader looks at it where it lies
    std::optional<Input> input;
    if (!foreign) input.emplace(o.input);
    const bool scene = input && is_scene(input->content());
    SceneDocument document =
        scene ? chosen_document(o, input->all(), input->name()) : chosen_document(o, empty_scene, "the scene");
    setting.scene = std::move(document.scene);
    if (scene) {
        setting.tree_files = tree_files(o.input, setting.scene);
        TreesRead read = read_trees(setting, o.input, o.shard, document.material);
        setting.notes = std::move(read.notes);
        setting.converted = std::move(read.converted);
        setting.looks = std::move(read.looks);
    } else {
        if (!o.shard.empty()) throw UsageError("--shard: only with a scene, whose trees it parts");
        if (!setting.scene.trees.empty())
            throw UsageError("--set trees: INPUT is a tree, which stands where it was drawn; a scene places trees");
        TreeOfFile read = foreign ? read_any_tree(o.input) : read_any_tree(*input, o.input);
        if (read.imported) setting.converted = {o.input};
        setting.imported = std::move(read.imported);
        setting.notes = std::move(read.notes);
        stand(setting, with_material(std::move(read.tree), document.material, o.input), Placement());
    }
    if (const std::optional<Defect> defect = check(setting.scene))
        throw UsageError("the scene's " + defect->field + " " + defect->message);
    apply_scene(setting, o.input);
    return setting;
}

std::vector<std::string> files_read(const RunOptions& o) {
    std::vector<std::string> files{o.input};
    if (const std::string wind = wind_file(o.wind); !wind.empty()) files.push_back(wind);
    if (is_converted(o.input)) return files;
    const Input input(o.input);
    if (is_scene(input.content()))
        for (const std::string& file : tree_files(o.input, chosen_document(o, input.all(), input.name()).scene))
            files.push_back(file);
    return files;
}

void refuse_overwriting_trees(const Setting& setting, const std::vector<NamedFile>& written) {
    std::vector<NamedFile> read;
    for (const std::string& file : setting.tree_files) read.push_back({"the scene", file});
    refuse_overwriting(read, written);
    refuse_overwriting_the_model(written);
}

Scene chosen_scene(const RunOptions& o) {
    Scene scene = chosen_document(o, empty_scene, "the scene").scene;
    if (const std::optional<Defect> defect = check(scene))
        throw UsageError("the scene's " + defect->field + " " + defect->message);
    return scene;
}

} // namespace bough
