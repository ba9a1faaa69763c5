#include "shown_model.h"
#include "exits.h"
#include "formats/documents/scene.h"
#include "formats/mapped.h"
#include "formats/models/gltf_document.h"
#include "formats/models/model_kind.h"
#include "formats/models/reader_limits.h"
#include "import_file.h"
#include "lib/model/drawn_pose.h"
#include <algorithm>
#include <numbers>

namespace bough {
namespace {

// Whether files' own meshes are wanted, where they have some.
bool wants_own(const TreesimOptions& o, const std::string& format) {
    return is_mesh(format) && o.skin.empty() && o.mesh != "made";
}
// INPUT's own, which stdin is not read twice for.
bool wants_inputs_own(const TreesimOptions& o, const std::string& format) {
    return wants_own(o, format) && o.run.input != "-";
}

// Whether a mesh of it is in Draco's form, which a .glb keeps and no other output can show.
bool is_packed(const UserModel& model) {
    const auto used = model.document->json.value("extensionsUsed", nlohmann::ordered_json::array());
    return std::find(used.begin(), used.end(), "KHR_draco_mesh_compression") != used.end();
}

// Whether a node of it has all these.
bool has_node_with(const UserModel& model, const std::initializer_list<const char*>& keys) {
    for (const auto& node : model.document->json.value("nodes", nlohmann::ordered_json::array()))
        if (std::all_of(keys.begin(), keys.end(), [&](const char* key) { return node.contains(key); })) return true;
    return false;
}

void add_notes(const std::string& name, const ImportNotes& notes, TreesimOptions& o) {
    for (const std::string& line : notes.lines) o.common.notes.push_back(name + ": " + line);
}

// all: every tree shows the mesh of a file.
void refuse_unused(const TreesimOptions& o, bool all) {
    const std::string made = o.skin.empty()
                                 ? "only with --mesh made, as " + input_name(o.run.input) + " shows a file's own mesh"
                                 : "not with --skin, whose mesh is its own";
    if (o.sides && all) throw UsageError("--sides: " + made);
    if (o.rustle) throw UsageError("--rustle: " + made);
    if (!o.gltf.leaves_as.empty()) throw UsageError("--leaves-as: " + made);
}

// Whether the tree, where the scene has put it, stands where the model's file has it rather than where an import sets it (`moved`): it was
// made with --keep-place.
bool kept_its_place(const Setting& setting, const Vec3& moved) {
    const Placement place = setting.scene.trees.empty() ? Placement() : setting.scene.trees.front();
    const DrawnPose pose = drawn_pose(setting.tree);
    Vec3 foot = Vec3::Zero();
    double lowest = INFINITY, roots = 0;
    for (std::size_t i = 0; i < setting.tree.size_bodies(); ++i)
        if (setting.tree.parent[i] < 0) {
            foot += pose.x_w[i];
            lowest = std::min(lowest, pose.x_w[i].y());
            ++roots;
        }
    foot /= roots;
    foot.y() = lowest;
    const Eigen::AngleAxisd back(-place.yaw * std::numbers::pi / 180, Vec3::UnitY());
    const Vec3 before = back * (foot - place.position);
    return (before + moved).norm() < before.norm();
}

// why: what reading a file's model said, with its place.
[[noreturn]] void refuse_own_mesh(const std::string& why, const std::string& file) {
    const std::string name = input_name(file);
    throw InputError(name + ": its own mesh", (why.starts_with(name + ": ") ? why.substr(name.size() + 2) : why) +
                                                  "; --mesh made shows one that is made from the tree");
}

SpeedtreeModel speedtree_model(TreesimOptions& o, const std::string& path, const Setting& setting) {
    ImportNotes found, notes;
    if (path == o.run.input && setting.imported)
        found = *setting.imported;
    else
        read_import(path, {}, found); // for its unit, its axes and where it stands
    if (!o.skin.empty() && setting.ranges.size() == 1 && kept_its_place(setting, found.moved)) found.moved.setZero();
    const MappedInput file(path);
    SpeedtreeModel model;
    try {
        model = read_speedtree_model(file.content(), path, found, notes, [&file] { file.give_back(); });
    } catch (const NoOwnMesh& error) {
        if (o.skin.empty()) throw NoOwnMesh(error.name, "; --mesh made shows one that is made from the tree");
        throw;
    }
    file.check();
    add_notes(model.name, notes, o);
    return model;
}

// The skinned model of a file whose own mesh is wanted, none where it has none that can be shown: a note says so.
// Throws InputError, as LimitError where memory or time did not suffice.
std::optional<UserModel> skinned_model(TreesimOptions& o, const std::string& path, const std::string& format) {
    ImportNotes notes;
    UserModel own;
    try {
        own = read_user_model(path, notes);
    } catch (const NoSkinnedMesh& error) {
        o.common.notes.push_back(std::string(error.what()) + ": a mesh made from the tree is shown");
        return std::nullopt;
    }
    if (!has_node_with(own, {"mesh", "skin"})) {
        if (has_node_with(own, {"mesh"}))
            o.common.notes.push_back(own.name +
                                     ": no bones move its mesh (it has no skin): one made from the tree is shown");
        return std::nullopt;
    }
    if (format != "glb" && is_packed(own)) {
        if (o.mesh == "own") throw InputError(own.name, "is in Draco's form, which is not read");
        o.common.notes.push_back(own.name + ": its mesh is in Draco's form, which is not read: one made from the "
                                            "tree is shown");
        return std::nullopt;
    }
    add_notes(own.name, notes, o);
    return own;
}

// Of a file that a scene names.
std::optional<UserModel> skinned_model_of_scene(TreesimOptions& o, const std::string& path, const std::string& format) {
    try {
        return skinned_model(o, path, format);
    } catch (const ImageError&) {
        throw; // says enough
    } catch (const InputError& error) {
        if (o.mesh == "own") refuse_own_mesh(error.what(), path);
        o.common.notes.push_back(std::string(error.what()) + ": a mesh made from the tree is shown");
        return std::nullopt;
    }
}

// Of the files that a scene names.
void add_models_of_scene(ShownModel& model, TreesimOptions& o, const Setting& setting, const std::string& format) {
    for (const std::string& path : setting.converted) {
        std::vector<std::size_t> trees;
        for (std::size_t k = 0; k < setting.ranges.size(); ++k)
            if (tree_file(o.run.input, setting.scene.trees[k]) == path) trees.push_back(k);
        if (trees.empty()) continue;
        if (is_speedtree_file(path)) {
            if (has_speedtree_mesh(MappedInput(path).content()))
                model.bound.push_back({speedtree_model(o, path, setting), std::move(trees)});
        } else if (model_kind(MappedInput(path).content())) {
            if (std::optional<UserModel> own = skinned_model_of_scene(o, path, format))
                model.skinned.push_back({std::move(*own), std::move(trees)});
        }
    }
}

} // namespace

ShownModel model_before_threads(TreesimOptions& o, const std::string& format) {
    ShownModel model;
    if (!o.skin.empty()) {
        if (is_speedtree_file(o.skin)) return model;
        ImportNotes notes;
        model.driven = read_user_model(o.skin, notes);
        add_notes(model.driven->name, notes, o);
        return model;
    }
    if (!wants_inputs_own(o, format) || !model_kind(MappedInput(o.run.input).content())) return model;
    try {
        model.driven = skinned_model(o, o.run.input, format);
    } catch (const LimitError& error) {
        refuse_own_mesh(error.what(), o.run.input);
    } catch (const ImageError&) {
        throw; // the import looks at no image
    } catch (const InputError& error) {
        model.failed = error.what();
    }
    if (!model.driven) return model;
    if (!o.gltf.max_joints.empty())
        throw UsageError("--max-joints: only with --mesh made, as " + input_name(o.run.input) +
                         " has a mesh and bones of its own");
    return model;
}

void complete_model(ShownModel& model, TreesimOptions& o, const Setting& setting, const std::string& format) {
    if (!model.failed.empty()) refuse_own_mesh(model.failed, o.run.input);
    if (!o.skin.empty() && !model.driven) {
        model.bound.push_back({speedtree_model(o, o.skin, setting), {0}});
    } else if (!o.skin.empty()) {
        if (setting.ranges.size() == 1 && kept_its_place(setting, model.driven->moved)) model.driven->moved.setZero();
    } else if (wants_inputs_own(o, format) && setting.imported) {
        const bool speedtree = is_speedtree_file(o.run.input) && has_speedtree_mesh(MappedInput(o.run.input).content());
        if (speedtree) model.bound.push_back({speedtree_model(o, o.run.input, setting), {0}});
    }
    if (wants_own(o, format) && !setting.tree_files.empty()) add_models_of_scene(model, o, setting, format);
    if (o.run.input == "-" && setting.imported && o.skin.empty() && o.mesh != "made" && is_mesh(format) &&
        setting.imported->format == "SpeedTree raw XML")
        o.common.notes.push_back(
            "<stdin>: the mesh is made from the tree; the file's own is shown where INPUT names it");
    if (o.mesh == "own" && !model)
        throw UsageError("--mesh own: " + input_name(o.run.input) + " has no mesh that could be moved");
    std::size_t shows = model.driven ? setting.ranges.size() : 0;
    for (const FileModel& file : model.bound) shows += file.trees.size();
    for (const SkinnedFile& file : model.skinned) shows += file.trees.size();
    if (model) refuse_unused(o, shows >= setting.ranges.size());
    if (!o.skin.empty() && setting.ranges.size() != 1)
        throw UsageError("--skin: the scene has " + std::to_string(setting.ranges.size()) +
                         " trees, expected one, which the model is of");
}

} // namespace bough
