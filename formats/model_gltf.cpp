#include "model_gltf.h"
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

bool encoded(const Json& json, const Json& primitive) {
    if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression")) return true;
    const Json& attributes = primitive.at("attributes");
    if (!attributes.contains("POSITION")) return false;
    const Json& accessor = json.at("accessors").at(attributes["POSITION"].get<std::size_t>());
    if (accessor.value("componentType", 0) != 5126) return true;
    if (!accessor.contains("bufferView")) return false;
    const Json& view = json.at("bufferViews").at(accessor["bufferView"].get<std::size_t>());
    return view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression");
}

bool any_encoded(const Json& json) {
    for (const Json& mesh : json.value("meshes", Json::array()))
        for (const Json& primitive : mesh.at("primitives"))
            if (encoded(json, primitive)) return true;
    return false;
}

void keep_geometry(Json& primitive) {
    for (const char* other : {"material", "extensions", "targets", "extras"}) primitive.erase(other);
    Json kept = Json::object();
    for (const auto& [name, accessor] : primitive["attributes"].items())
        if (name == "POSITION" || name == "JOINTS_0" || name == "WEIGHTS_0" || name == "JOINTS_1" ||
            name == "WEIGHTS_1")
            kept[name] = accessor;
    primitive["attributes"] = std::move(kept);
}

} // namespace

GltfJoints cut_down(Json& json) {
    GltfJoints found;
    if (!json.contains("nodes")) json["nodes"] = Json::array();
    found.joint.assign(json["nodes"].size(), false);
    for (const Json& skin : json.value("skins", Json::array()))
        for (const Json& joint : skin.at("joints")) {
            found.joint.at(joint.get<std::size_t>()) = true;
            found.any = true;
        }
    found.own = own_rods(json["nodes"]);
    found.mesh_encoded = any_encoded(json);
    for (const char* other : {"animations", "materials", "textures", "images", "samplers", "cameras", "extensions",
                              "extensionsUsed", "extensionsRequired", "extras"})
        json.erase(other);
    if (found.mesh_encoded) json.erase("meshes");
    if (found.mesh_encoded || !json.contains("meshes")) json.erase("skins");
    const bool skins = json.contains("skins");
    Json& nodes = json["nodes"]; // only now: an ordered object's values move when one before them goes
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        Json& node = nodes[i];
        found.name.push_back(node.value("name", std::string()));
        node["name"] = "#" + std::to_string(i);
        for (const char* other : {"camera", "extensions", "extras", "weights"}) node.erase(other);
        if (found.mesh_encoded) node.erase("mesh");
        if (!skins) node.erase("skin");
    }
    if (json.contains("meshes"))
        for (Json& mesh : json["meshes"]) {
            mesh.erase("weights");
            for (Json& primitive : mesh.at("primitives")) keep_geometry(primitive);
        }
    return found;
}

} // namespace bough
