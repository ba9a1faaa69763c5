#include "model_gltf.h"
#include "gltf_accessor.h"
#include "lib/model/counted.h"
#include "plain_text.h"
#include <algorithm>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

bool compressed(const Json& json, const Json& accessor) {
    if (!accessor.contains("bufferView")) return false;
    const Json& view = json.at("bufferViews").at(accessor["bufferView"].get<std::size_t>());
    return view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression");
}

bool encoded(const Json& json, const Json& primitive) {
    if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression")) return true;
    const Json& attributes = primitive.at("attributes");
    if (!attributes.contains("POSITION")) return false;
    const Json& accessor = json.at("accessors").at(attributes["POSITION"].get<std::size_t>());
    if (accessor.value("componentType", 0) != 5126) return true;
    return compressed(json, accessor) ||
           (primitive.contains("indices") &&
            compressed(json, json.at("accessors").at(primitive["indices"].get<std::size_t>())));
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
            name == "WEIGHTS_1" || name == "TEXCOORD_0")
            kept[name] = accessor;
    primitive["attributes"] = std::move(kept);
}

// What times the attribute is a radius; 0: it is none.
double radius_factor(std::string_view attribute) {
    const std::string name = lower_case(attribute);
    if (name == "_radius") return 1;
    return name == "_diameter" || name == "_width" || name == "_thickness" ? 0.5 : 0;
}

void prepare_lines(GltfDocument& document, std::size_t mesh, std::size_t number) {
    const auto primitive = [&]() -> Json& { return document.json["meshes"][mesh]["primitives"][number]; };
    const std::string place = "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(number) + ": ";
    const std::int64_t mode = primitive().value("mode", std::int64_t(4));
    if (mode < 1 || mode > 3 || !primitive().at("attributes").contains("POSITION")) return;
    const Json& attributes = primitive()["attributes"];
    const std::size_t count = document.json.at("accessors").at(attributes["POSITION"].get<std::size_t>()).at("count");
    if (primitive().contains("indices"))
        for (const double index : scalars_of(document, primitive()["indices"].get<std::size_t>()))
            if (!(index >= 0 && index < double(count)))
                throw std::out_of_range(place + "a line names vertex " + shown(index) + ", expected 0 to " +
                                        std::to_string(std::int64_t(count) - 1));
    for (const auto& [name, accessor] : attributes.items()) {
        const double factor = radius_factor(name);
        if (factor == 0) continue;
        const std::vector<double> values = scalars_of(document, accessor.get<std::size_t>());
        if (values.size() != count)
            throw std::out_of_range(place + name + " has " + counted(values.size(), "number", "numbers") +
                                    ", expected one for each of " + counted(count, "vertex", "vertices"));
        std::vector<float> radius;
        for (const double value : values) radius.push_back(float(factor * value));
        const std::size_t added = add_floats(document, radius, "SCALAR", false); // moves what the references above name
        primitive()["attributes"]["TEXCOORD_0"] = added;
        return;
    }
}

// A skin may leave its matrices out, which then are identities; assimp crashes without them, or with fewer than joints.
void complete_skin(GltfDocument& document, std::size_t number) {
    const std::size_t joints = document.json["skins"][number].at("joints").size();
    if (document.json["skins"][number].contains("inverseBindMatrices")) {
        const std::size_t index = document.json["skins"][number]["inverseBindMatrices"].get<std::size_t>();
        const Json& accessor = document.json.at("accessors").at(index);
        const std::size_t count = accessor.at("count").get<std::size_t>();
        if (count < joints || accessor.at("type") != "MAT4" || accessor.at("componentType") != 5126)
            throw std::out_of_range("skin " + std::to_string(number) + " has " + std::to_string(count) + " " +
                                    accessor.at("type").dump() + " of type " + accessor.at("componentType").dump() +
                                    ", expected a MAT4 of floats for each of " + counted(joints, "joint", "joints"));
        return;
    }
    std::vector<float> identities(16 * joints, 0);
    for (std::size_t k = 0; k < identities.size(); ++k) identities[k] = k % 16 % 5 == 0 ? 1 : 0;
    const std::size_t added = add_floats(document, identities, "MAT4", false);
    document.json["skins"][number]["inverseBindMatrices"] = added;
}

// A file may leave its scenes out; assimp wants one.
void add_missing_scene(Json& json) {
    if (json.contains("scenes") && !json["scenes"].empty()) return;
    std::vector<char> root(json["nodes"].size(), true);
    for (const Json& node : json["nodes"])
        for (const Json& child : node.value("children", Json::array())) root.at(child.get<std::size_t>()) = false;
    Json nodes = Json::array();
    for (std::size_t i = 0; i < root.size(); ++i)
        if (root[i]) nodes.push_back(i);
    json["scenes"] = Json::array({Json{{"nodes", std::move(nodes)}}});
    json["scene"] = 0;
}

} // namespace

GltfJoints cut_down(GltfDocument& document) {
    GltfJoints found;
    Json& json = document.json;
    if (!json.contains("nodes")) json["nodes"] = Json::array();
    found.joint.assign(json["nodes"].size(), false);
    for (const Json& skin : json.value("skins", Json::array()))
        for (const Json& joint : skin.at("joints")) {
            found.joint.at(joint.get<std::size_t>()) = true;
            found.any = true;
        }
    found.own = own_rods(json["nodes"]);
    add_missing_scene(json);
    found.other_scenes = json["scenes"].size() - 1;
    found.mesh_encoded = any_encoded(json);
    for (const char* other : {"animations", "materials", "textures", "images", "samplers", "cameras", "extensions",
                              "extensionsUsed", "extensionsRequired", "extras"})
        json.erase(other);
    if (found.mesh_encoded) json.erase("meshes");
    if (found.mesh_encoded || !json.contains("meshes")) json.erase("skins");
    const bool skins = json.contains("skins");
    for (std::size_t s = 0; skins && s < json["skins"].size(); ++s) complete_skin(document, s);
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
        for (std::size_t m = 0; m < json["meshes"].size(); ++m) {
            json["meshes"][m].erase("weights");
            for (std::size_t p = 0; p < json["meshes"][m].at("primitives").size(); ++p) {
                json["meshes"][m]["primitives"][p].at("attributes").erase("TEXCOORD_0");
                prepare_lines(document, m, p);
                keep_geometry(json["meshes"][m]["primitives"][p]);
            }
        }
    return found;
}

} // namespace bough
