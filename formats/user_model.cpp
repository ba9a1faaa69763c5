#include "user_model.h"
#include "gltf_document.h"
#include "plain_text.h"

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

// What assimp's writer gets wrong: an embedded image's type is the ending of its file or folder ("fbm"), and a morph target
// has as many vertices as its mesh had before they were split.
void mend_assimp(GltfDocument& document, ImportNotes& notes) {
    nlohmann::ordered_json& json = document.json;
    if (json.contains("images"))
        for (nlohmann::ordered_json& image : json["images"]) {
            if (!image.contains("bufferView")) continue;
            const auto& view = json.at("bufferViews").at(image["bufferView"].get<std::size_t>());
            const std::string_view bytes = std::string_view(document.binary).substr(view.value("byteOffset", 0u));
            if (bytes.starts_with("\x89PNG")) image["mimeType"] = "image/png";
            if (bytes.starts_with("\xFF\xD8")) image["mimeType"] = "image/jpeg";
        }
    if (!json.contains("meshes")) return;
    const auto count = [&](const nlohmann::ordered_json& accessor) {
        return json.at("accessors").at(accessor.get<std::size_t>()).at("count").get<std::size_t>();
    };
    std::size_t without = 0;
    for (nlohmann::ordered_json& mesh : json["meshes"]) {
        bool fit = true, any = false;
        for (const auto& primitive : mesh.at("primitives"))
            for (const auto& target : primitive.value("targets", nlohmann::ordered_json::array()))
                for (const auto& accessor : target) {
                    any = true;
                    fit = fit && count(accessor) == count(primitive.at("attributes").at("POSITION"));
                }
        if (!any || fit) continue;
        ++without;
        for (const char* name : {"weights", "extras"}) mesh.erase(name);
        for (nlohmann::ordered_json& primitive : mesh["primitives"]) primitive.erase("targets");
    }
    if (without > 0)
        notes.lines.push_back(std::to_string(without) + " meshes come without their shape keys: assimp does not keep " +
                              "them with the vertices (export glTF to keep them)");
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
        throw InputError(options.name, "has no armature, expected bones that move its mesh");
    for (const std::int32_t node : model.armature.node) model.joint.push_back(scene.index[node]);
    for (std::size_t b = 0; b < model.joint.size(); ++b)
        if (model.joint[b] < 0 || !model.armature.bones[b].start.allFinite())
            throw InputError(options.name, "has a bone that is no node, or whose place is not finite");
    model.moved = moved_by_import(model.armature, options);
    return model;
}

} // namespace bough
