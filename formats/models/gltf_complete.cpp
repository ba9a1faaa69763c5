#include "gltf_complete.h"
#include "gltf_accessor.h"

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

void weights_as_floats(GltfDocument& document, std::size_t mesh, std::size_t number, const std::string& attribute) {
    const Json& attributes = document.json["meshes"][mesh]["primitives"][number].at("attributes");
    if (!attributes.contains(attribute)) return;
    const std::string place = primitive_place(mesh, number);
    const std::size_t index = index_of(attributes, attribute.c_str(), place, entries_of(document.json, "accessors"));
    if (document.json["accessors"][index].at("componentType") == 5126) return;
    const std::vector<double> values =
        values_of(document, attributes[attribute], {place + ": " + attribute, "VEC4", GltfNumbers::weights});
    const std::size_t added = add_floats(document, {values.begin(), values.end()}, "VEC4", false); // moves `attributes`
    document.json["meshes"][mesh]["primitives"][number]["attributes"][attribute] = added;
}

} // namespace

void add_missing_scene(Json& document) {
    if (entries_of(document, "scenes") > 0) return;
    const Json& all = document.at("nodes");
    std::vector<char> root(all.size(), true);
    for (std::size_t i = 0; i < root.size(); ++i)
        for (const Json& child : all[i].value("children", Json::array()))
            root[checked_index(child, "a child of node " + std::to_string(i), root.size())] = false;
    Json nodes = Json::array();
    for (std::size_t i = 0; i < root.size(); ++i)
        if (root[i]) nodes.push_back(i);
    document["scenes"] = Json::array({Json{{"nodes", std::move(nodes)}}});
    document["scene"] = 0;
}

void add_missing_matrices(GltfDocument& document) {
    for (std::size_t s = 0; s < entries_of(document.json, "skins"); ++s) {
        const Json& skin = document.json["skins"][s];
        if (skin.contains("inverseBindMatrices")) continue;
        std::vector<float> identities(16 * skin.at("joints").size(), 0);
        for (std::size_t k = 0; k < identities.size(); ++k) identities[k] = k % 16 % 5 == 0 ? 1 : 0;
        const std::size_t added = add_floats(document, identities, "MAT4", false); // moves what `skin` refers to
        document.json["skins"][s]["inverseBindMatrices"] = added;
    }
}

void weights_as_floats(GltfDocument& document) {
    for (std::size_t m = 0; m < entries_of(document.json, "meshes"); ++m)
        for (std::size_t p = 0; p < document.json["meshes"][m].at("primitives").size(); ++p)
            for (const char* attribute : {"WEIGHTS_0", "WEIGHTS_1"}) weights_as_floats(document, m, p, attribute);
}

} // namespace bough
