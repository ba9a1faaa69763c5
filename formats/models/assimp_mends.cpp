#include "assimp_mends.h"

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

void mend_images(GltfDocument& document) {
    if (!document.json.contains("images")) return;
    for (Json& image : document.json["images"]) {
        if (!image.contains("bufferView")) continue;
        const Json& view = document.json.at("bufferViews").at(image["bufferView"].get<std::size_t>());
        const char* const type =
            image_type(std::string_view(document.binary).substr(view.value("byteOffset", std::size_t(0))));
        if (type) image["mimeType"] = type;
    }
}

std::size_t count_of(const Json& json, const Json& accessor) {
    return json.at("accessors").at(accessor.get<std::size_t>()).at("count").get<std::size_t>();
}

bool targets_fit(const Json& json, const Json& mesh) {
    for (const Json& primitive : mesh.at("primitives"))
        for (const Json& target : primitive.value("targets", Json::array()))
            for (const Json& accessor : target)
                if (count_of(json, accessor) != count_of(json, primitive.at("attributes").at("POSITION"))) return false;
    return true;
}

void mend_targets(Json& json, ImportNotes& notes) {
    if (!json.contains("meshes")) return;
    std::size_t without = 0;
    for (Json& mesh : json["meshes"]) {
        if (targets_fit(json, mesh)) continue;
        ++without;
        for (const char* name : {"weights", "extras"}) mesh.erase(name);
        for (Json& primitive : mesh["primitives"]) primitive.erase("targets");
    }
    if (without > 0)
        notes.lines.push_back(std::to_string(without) + (without == 1 ? " mesh comes" : " meshes come") +
                              " without shape keys: assimp does not keep them with the vertices (export glTF to keep "
                              "them)");
}

} // namespace

void mend_assimp(GltfDocument& document, ImportNotes& notes) {
    mend_images(document);
    mend_targets(document.json, notes);
}

} // namespace bough
