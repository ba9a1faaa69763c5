#include "model_gltf.h"
#include "gltf_check.h"
#include "gltf_complete.h"
#include "meshopt.h"

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

bool any_encoded(const Json& json) {
    for (std::size_t m = 0; m < entries_of(json, "meshes"); ++m)
        for (const Json& primitive : json["meshes"][m].at("primitives"))
            if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression"))
                return true;
    return false;
}

} // namespace

GltfJoints joints_of(GltfDocument& document) {
    GltfJoints found;
    Json& json = document.json;
    if (!json.contains("nodes")) json["nodes"] = Json::array();
    found.joint.assign(json["nodes"].size(), false);
    for (std::size_t s = 0; s < entries_of(json, "skins"); ++s)
        for (const Json& joint : json["skins"][s].at("joints"))
            found.joint[checked_index(joint, "a joint of skin " + std::to_string(s), found.joint.size())] = true;
    for (const Json& node : json["nodes"]) found.name.push_back(node.value("name", std::string()));
    found.own = own_rods(json["nodes"]);
    add_missing_scene(json);
    found.other_scenes = json["scenes"].size() - 1;
    found.mesh_encoded = any_encoded(json);
    if (found.mesh_encoded) json.erase("meshes");
    if (!json.contains("meshes")) json.erase("skins");
    for (Json& node : json["nodes"]) { // only now: an ordered object's values move when one before them goes
        if (found.mesh_encoded) node.erase("mesh");
        if (!json.contains("skins")) node.erase("skin");
    }
    decode_meshopt(document);
    check_arrays(document);
    check_materials(document);
    add_missing_matrices(document);
    return found;
}

} // namespace bough
