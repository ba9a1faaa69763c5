#include "armature.h"
#include "formats/imports/imported_tree.h"
#include "formats/imports/line_graph.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"

namespace bough {
namespace {

bool recognizes(std::string_view content) {
    return model_kind(content).has_value();
}

// Coordinates that the options' up axis or the file's own statement turn to Y up.
Mat3 to_y_up(const ModelScene& scene, const ImportOptions& options) {
    Mat3 axes = scene.to_y_up;
    if (options.up == 'y') axes = Mat3::Identity();
    if (options.up == 'z') axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return axes;
}

[[noreturn]] void refuse(const ModelScene& scene, AssimpKind kind, const std::string& name) {
    throw InputError(
        name, std::string(kind == AssimpKind::fbx ? "is an " : "is a ") + model_kind_name(kind) + " model " +
                  (scene.triangles > 0 ? "of a mesh without bones or lines" : "without bones or lines") +
                  (scene.other_scenes > 0 ? " (its default scene; " + std::to_string(scene.other_scenes) +
                                                (scene.other_scenes == 1 ? " other is" : " others are") + " not read)"
                                          : "") +
                  ", which says nothing of where branches run; export it with its armature, or the "
                  "tree's curves as lines");
}

// Line meshes, as a tree that stands along +Y.
ImportedTree tree_of_line_meshes(ModelScene& scene, const Mat3& axes, const std::string& name, ImportNotes& notes) {
    for (Vec3& p : scene.line_point) {
        if (!p.allFinite()) throw InputError(name, "has a line whose place is not finite");
        p = axes * p;
    }
    for (const double r : scene.line_radius)
        if (!(r >= 0) || std::isinf(r))
            throw InputError(name, "has a line of radius " + shown(r) + ", expected 0 or more");
    LineGraph graph{std::move(scene.line_point), std::move(scene.line_radius), std::move(scene.line)};
    return tree_of_lines(std::move(graph), 'y', name, notes);
}

// The last steps of all models; `tree` stands along +Y.
Splines finish(ImportedTree&& tree, const ModelScene& scene, const ImportOptions& options, ImportNotes& notes) {
    if (scene.unit > 0) tree.unit = scene.unit;
    ImportOptions turned = options;
    turned.up = 'y';
    Splines made = finish_import(std::move(tree), turned, notes);
    notes.up = options.up != 0 ? options.up : scene.to_y_up.isIdentity(1e-6) ? 'y' : 'z';
    notes.up_from = options.up != 0 ? "given" : "stated";
    return made;
}

// A tree that we wrote, as it was.
Splines own_tree(const ModelScene& scene, const Mat3& axes, const ImportOptions& options, ImportNotes& notes) {
    ImportedTree tree;
    tree.branches = branches_of(scene.own_rod);
    for (ImportedBranch& branch : tree.branches)
        for (Vec3& p : branch.point) {
            if (!p.allFinite()) throw InputError(options.name, "has a joint whose place is not finite");
            p = axes * p;
        }
    tree.source = "bough's joints in " + options.name;
    if (scene.own_others > 0)
        notes.lines.push_back(std::to_string(scene.own_others) +
                              " leaves, petals and fruit left out: a .glb says where the wood is, not where they grow");
    return finish(std::move(tree), scene, options, notes);
}

Splines read(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    const AssimpKind kind = *model_kind(content);
    ModelScene scene = read_model(content, kind, options);
    const Mat3 axes = to_y_up(scene, options);
    if (!scene.own_rod.empty()) return own_tree(scene, axes, options, notes);
    Armature armature = armature_of(scene, axes.transpose() * Vec3::UnitY(), notes);
    const bool bones = !armature.bones.empty();
    if (scene.other_scenes > 0)
        notes.lines.push_back(counted(scene.other_scenes, "scene", "scenes") + " beside the default one not read");
    if (!bones && scene.line.empty()) refuse(scene, kind, options.name);
    if (bones && scene.mesh_encoded)
        notes.lines.push_back("the mesh is in Draco's form and was not read: radii come from the bones alone; save it "
                              "without compression");
    if (bones && scene.skinned_meshes == 0 && !scene.line.empty())
        notes.lines.push_back(counted(scene.line.size(), "line", "lines") + " not read beside the bones");
    for (speedtree::Bone& bone : armature.bones) {
        if (!bone.start.allFinite() || !bone.end.allFinite())
            throw InputError(options.name, "has a bone whose place is not finite");
        bone.start = axes * bone.start;
        bone.end = axes * bone.end;
    }
    for (Twig& twig : armature.twigs)
        for (Vec3& p : twig.point) p = axes * p;
    ImportedTree tree = bones ? tree_of(armature, notes) : tree_of_line_meshes(scene, axes, options.name, notes);
    tree.source = std::string(model_kind_name(kind)) + (bones ? " armature " : " lines ") + options.name;
    ImportOptions own_unit = options;
    if (options.unit && kind == AssimpKind::dae) // assimp has applied its own
        own_unit.unit = *options.unit / collada_unit(content);
    return finish(std::move(tree), scene, own_unit, notes);
}

} // namespace

const SplineFormat armature_format{"FBX, glTF or COLLADA armature or lines", recognizes, read};

} // namespace bough
