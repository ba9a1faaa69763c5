#include "user_model.h"
#include "assimp_mends.h"
#include "formats/plain_text.h"

namespace bough {
namespace {

// The lowest corners of the bones before and after they are brought in as a tree.
Vec3 moved_by_import(const Armature& armature, const ImportOptions& options) {
    ImportNotes none;
    ImportedTree tree = tree_of(armature, none);
    Vec3 before = Vec3::Constant(INFINITY), after = before;
    for (const ImportedBranch& branch : tree.branches)
        for (const Vec3& p : branch.point) before = before.cwiseMin(p);
    ImportOptions metres = options;
    metres.unit = 1;
    metres.up = 'y';
    for (const Vec3& p : finish_import(std::move(tree), metres, none).point) after = after.cwiseMin(p);
    const Vec3 way = after - before;
    return way.norm() > 1e-9 * (1 + before.norm()) ? way : Vec3(Vec3::Zero());
}

} // namespace

UserModel read_user_model(const std::string& path, ImportNotes& notes) {
    ImportOptions options;
    options.name = input_name(path);
    options.folder = folder_of(path);
    std::string content = read_input(path);
    const std::optional<AssimpKind> kind = model_kind(content);
    if (!kind)
        throw InputError(options.name, "is no model that can be moved, expected glTF (.glb, .gltf), FBX or COLLADA");
    if (*kind == AssimpKind::fbx || *kind == AssimpKind::dae) content = glb_by_assimp(content, *kind, options);
    UserModel model;
    model.name = options.name;
    model.document =
        std::make_shared<GltfDocument>(read_gltf(content, options.name, options.folder, GltfImages::embed, notes));
    if (*kind == AssimpKind::fbx || *kind == AssimpKind::dae) mend_assimp(*model.document, notes);
    const ModelScene scene = read_model(glb_of(*model.document, options.name), AssimpKind::glb, options);
    ImportNotes of_armature; // what was guessed of ends and radii has no part in this
    model.armature = armature_of(scene, Vec3::UnitY(), of_armature);
    if (model.armature.bones.empty())
        throw NoSkinnedMesh(options.name, "has no armature, expected bones that move its mesh");
    if (model.armature.mesh_beside)
        notes.lines.push_back(
            "the skin's bind matrices put the mesh beside its bones: it is shown there, as the file says");
    for (const std::int32_t node : model.armature.node) model.joint.push_back(scene.index[node]);
    for (std::size_t b = 0; b < model.joint.size(); ++b)
        if (model.joint[b] < 0 || !model.armature.bones[b].start.allFinite())
            throw InputError(options.name, "has a bone that is no node, or whose place is not finite");
    model.moved = moved_by_import(model.armature, options);
    return model;
}

} // namespace bough
