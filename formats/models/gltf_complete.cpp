#include "gltf_complete.h"

namespace bough {

using Json = nlohmann::ordered_json;

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

} // namespace bough
