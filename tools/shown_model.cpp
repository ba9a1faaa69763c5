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

// Whether INPUT's own mesh is wanted, if it has one.
bool wants_own(const TreesimOptions& o, const std::string& format) {
    return is_mesh(format) && o.skin.empty() && o.mesh != "made" && o.run.input != "-";
}

// A model's mesh that its bones move is shown by these.
bool shows_bones(const std::string& format) {
    return format == "glb" || format == "obj" || format == "vat" || is_point_cache(format);
}
constexpr const char* bones_shown_by = ".glb, frames of .obj, .mdd, .pc2 and NAME_vat/ alone";

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

void refuse_unused(const TreesimOptions& o) {
    const std::string made = o.skin.empty()
                                 ? "only with --mesh made, as " + input_name(o.run.input) + " shows a file's own mesh"
                                 : "not with --skin, whose mesh is its own";
    if (o.sides) throw UsageError("--sides: " + made);
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

// why: what reading INPUT's model said, with its place.
[[noreturn]] void refuse_own_mesh(const std::string& why, const TreesimOptions& o) {
    const std::string name = input_name(o.run.input);
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

// Of the files that a scene names.
std::vector<FileModel> models_of_scene(TreesimOptions& o, const Setting& setting) {
    std::vector<FileModel> models;
    for (const std::string& path : setting.converted) {
        std::vector<std::size_t> trees;
        for (std::size_t k = 0; k < setting.ranges.size(); ++k)
            if (tree_file(o.run.input, setting.scene.trees[k]) == path) trees.push_back(k);
        if (trees.empty()) continue;
        if (!is_speedtree_file(path)) {
            if (model_kind(MappedInput(path).content()))
                o.common.notes.push_back(path + ": a scene shows a mesh made from its tree; its own, where it has one "
                                                "that bones move, is shown where it is INPUT (or --skin) alone");
            continue;
        }
        if (!has_speedtree_mesh(MappedInput(path).content())) continue;
        models.push_back({speedtree_model(o, path, setting), std::move(trees)});
    }
    return models;
}

// --mesh own, where there is none.
[[noreturn]] void refuse_no_mesh(const TreesimOptions& o, const Setting& setting) {
    for (const std::string& path : setting.converted)
        if (!setting.tree_files.empty() && model_kind(MappedInput(path).content()))
            throw UsageError("--mesh own: " + path +
                             " has a mesh that bones move, which a scene does not show; name the file as INPUT or by "
                             "--skin, or leave --mesh own out for a mesh that is made from the tree");
    throw UsageError("--mesh own: " + input_name(o.run.input) + " has no mesh that could be moved");
}

} // namespace

ShownModel model_before_threads(TreesimOptions& o, const std::string& format) {
    ShownModel model;
    ImportNotes notes;
    if (!o.skin.empty()) {
        if (is_speedtree_file(o.skin)) return model;
        if (!shows_bones(format))
            throw UsageError(std::string("--skin: only with ") + bones_shown_by + ", where it is no SpeedTree XML");
        model.driven = read_user_model(o.skin, notes);
        add_notes(model.driven->name, notes, o);
        return model;
    }
    if (!shows_bones(format) || !wants_own(o, format) || !model_kind(MappedInput(o.run.input).content())) return model;
    try {
        UserModel own = read_user_model(o.run.input, notes);
        if (!has_node_with(own, {"mesh", "skin"})) {
            if (has_node_with(own, {"mesh"}))
                o.common.notes.push_back(own.name +
                                         ": no bones move its mesh (it has no skin): one made from the tree is shown");
            return model;
        }
        if (format != "glb" && is_packed(own)) {
            if (o.mesh == "own") refuse_own_mesh("is in Draco's form, which is not read", o);
            o.common.notes.push_back(own.name + ": its mesh is in Draco's form, which is not read: one made from the "
                                                "tree is shown");
            return model;
        }
        model.driven = std::move(own);
    } catch (const LimitError& error) {
        refuse_own_mesh(error.what(), o);
    } catch (const ImageError&) {
        throw; // the import looks at no image
    } catch (const NoSkinnedMesh& error) {
        o.common.notes.push_back(std::string(error.what()) + ": a mesh made from the tree is shown");
        return model;
    } catch (const InputError& error) {
        model.failed = error.what();
        return model;
    }
    if (!o.gltf.max_joints.empty())
        throw UsageError("--max-joints: only with --mesh made, as " + input_name(o.run.input) +
                         " has a mesh and bones of its own");
    add_notes(model.driven->name, notes, o);
    return model;
}

void complete_model(ShownModel& model, TreesimOptions& o, const Setting& setting, const std::string& format) {
    if (!model.failed.empty()) refuse_own_mesh(model.failed, o);
    if (!o.skin.empty() && !model.driven) {
        model.bound.push_back({speedtree_model(o, o.skin, setting), {0}});
    } else if (!o.skin.empty()) {
        if (setting.ranges.size() == 1 && kept_its_place(setting, model.driven->moved)) model.driven->moved.setZero();
    } else if (wants_own(o, format) && setting.imported) {
        const bool speedtree = is_speedtree_file(o.run.input) && has_speedtree_mesh(MappedInput(o.run.input).content());
        if (speedtree) model.bound.push_back({speedtree_model(o, o.run.input, setting), {0}});
        if (!shows_bones(format) && !speedtree && model_kind(MappedInput(o.run.input).content())) {
            const std::string name = input_name(o.run.input),
                              of_others = std::string(": a mesh that bones move is shown by ") + bones_shown_by;
            if (o.mesh == "own")
                throw UsageError("--mesh own: " + name + of_others +
                                 "; --mesh made shows one that is made from the tree");
            o.common.notes.push_back(name + of_others + "; this one is made from the tree");
        }
    }
    if (wants_own(o, format) && !setting.tree_files.empty()) model.bound = models_of_scene(o, setting);
    if (o.run.input == "-" && setting.imported && o.skin.empty() && o.mesh != "made" && is_mesh(format) &&
        setting.imported->format == "SpeedTree raw XML")
        o.common.notes.push_back(
            "<stdin>: the mesh is made from the tree; the file's own is shown where INPUT names it");
    if (o.mesh == "own" && !model) refuse_no_mesh(o, setting);
    if (model) refuse_unused(o);
    if (!o.skin.empty() && setting.ranges.size() != 1)
        throw UsageError("--skin: the scene has " + std::to_string(setting.ranges.size()) +
                         " trees, expected one, which the model is of");
}

} // namespace bough
