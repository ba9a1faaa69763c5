// models.cpp: formats/models as a page has it: glTF is read here as everywhere; FBX and COLLADA, which assimp reads in a process of its own, are
// refused with what to do; what meshoptimizer compressed is refused too; a file's textures are not looked for,
// since a page has no folder beside it.
#include "formats/error.h"
#include "formats/models/meshopt.h"
#include "formats/models/model_scene.h"
#include "formats/models/texture_file.h"

namespace bough {

ModelScene read_model(std::string_view content, AssimpKind kind, const ImportOptions& options) {
    if (kind == AssimpKind::glb || kind == AssimpKind::gltf) return scene_of_gltf(content, options);
    throw InputError(
        options.name,
        std::string("is ") + model_kind_name(kind) +
            ", which this page does not read; on the command line treeconvert makes a tree of it (treeconvert FILE -o "
            "tree.safetensors), or save it as glTF");
}

void decode_meshopt(GltfDocument& document) {
    for (std::size_t v = 0; v < entries_of(document.json, "bufferViews"); ++v)
        if (document.json["bufferViews"][v]
                .value("extensions", nlohmann::ordered_json::object())
                .contains("EXT_meshopt_compression"))
            throw std::out_of_range("view " + std::to_string(v) +
                                    " is compressed (EXT_meshopt_compression), which this page does not read; on the "
                                    "command line treeconvert reads it, or save it without compression");
}

std::string find_texture(const std::string&, const std::string&, TexturePlaces&) {
    return "";
}
Texture read_texture(const std::string& path, const std::string&) {
    throw InputError(path, "is a texture, which this page does not read");
}
std::string png_of(int, int, int, const std::vector<std::uint8_t>&) {
    return "";
}
std::uint8_t channel_at(const Pixels&, int, int, int, int, int) {
    return 0;
}
bool Pixels::transparent() const {
    return false;
}

} // namespace bough
