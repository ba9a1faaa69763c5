// left_to_tools.cpp: what only the tools read, refused with the line that has them do it. bough_imports and the page are linked with this in place of
// model_scene.cpp, where assimp reads FBX and COLLADA, and meshopt.cpp.
#include "formats/error.h"
#include "formats/in_shell.h"
#include "formats/plain_text.h"
#include "meshopt.h"
#include "model_scene.h"

namespace bough {

ModelScene read_model(std::string_view content, AssimpKind kind, const ImportOptions& options) {
    if (kind == AssimpKind::glb || kind == AssimpKind::gltf) return scene_of_gltf(content, options);
    const bool memory = options.name.empty() || options.name[0] == '<';
    throw InputError(options.name, std::string(kind == AssimpKind::fbx ? "is an " : "is a ") + model_kind_name(kind) +
                                       " model, which the tools alone read; by hand: treeconvert " +
                                       (memory ? "FILE" : in_shell(options.name)) + " -o " +
                                       (memory ? "tree.json" : in_shell(stem_of(options.name) + ".tree.json")) +
                                       "; or save it as glTF");
}

void decode_meshopt(GltfDocument& document) {
    for (std::size_t v = 0; v < entries_of(document.json, "bufferViews"); ++v)
        if (document.json["bufferViews"][v]
                .value("extensions", nlohmann::ordered_json::object())
                .contains("EXT_meshopt_compression"))
            throw std::out_of_range("view " + std::to_string(v) +
                                    " is compressed (EXT_meshopt_compression), which the tools alone read; by hand: "
                                    "treeconvert FILE -o tree.json; or save it without compression");
}

} // namespace bough
