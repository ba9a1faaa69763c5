#include "model_gltf.h"
#include "formats/plain_text.h"
#include "gltf_accessor.h"
#include "gltf_check.h"
#include "gltf_complete.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <array>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array arrays_kept{"POSITION", "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"};

bool compressed(const Json& json, const Json& accessor, const std::string& place) {
    if (!accessor.contains("bufferView")) return false;
    const Json& view = json.at("bufferViews")[index_of(accessor, "bufferView", place, entries_of(json, "bufferViews"))];
    return view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression");
}

bool encoded(const Json& json, const Json& primitive, const std::string& place, bool quantized) {
    if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression")) return true;
    const auto accessor = [&](const Json& of, const char* key) -> const Json& {
        return json.at("accessors")[index_of(of, key, place, entries_of(json, "accessors"))];
    };
    const Json& attributes = primitive.at("attributes");
    if (!attributes.contains("POSITION")) return false;
    if (!quantized && accessor(attributes, "POSITION").value("componentType", 0) != 5126) return true;
    for (const char* kept : arrays_kept)
        if (attributes.contains(kept) && compressed(json, accessor(attributes, kept), place + ": " + kept)) return true;
    return primitive.contains("indices") && compressed(json, accessor(primitive, "indices"), place + ": indices");
}

bool any_encoded(const Json& json, bool quantized) {
    for (std::size_t m = 0; m < entries_of(json, "meshes"); ++m) {
        const Json& primitives = json["meshes"][m].at("primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p)
            if (encoded(json, primitives[p], primitive_place(m, p), quantized)) return true;
    }
    for (std::size_t s = 0; s < entries_of(json, "skins"); ++s) {
        const Json& skin = json["skins"][s];
        const std::string place = "skin " + std::to_string(s);
        if (!skin.contains("inverseBindMatrices")) continue;
        const std::size_t index = index_of(skin, "inverseBindMatrices", place, entries_of(json, "accessors"));
        if (compressed(json, json["accessors"][index], place + ": inverseBindMatrices")) return true;
    }
    return false;
}

void keep_geometry(Json& primitive) {
    for (const char* other : {"material", "extensions", "targets", "extras"}) primitive.erase(other);
    Json kept = Json::object();
    for (const auto& [name, accessor] : primitive["attributes"].items())
        if (name == "TEXCOORD_0" || std::find(arrays_kept.begin(), arrays_kept.end(), name) != arrays_kept.end())
            kept[name] = accessor;
    primitive["attributes"] = std::move(kept);
}

// What times the attribute is a radius; 0: it is none.
double radius_factor(std::string_view attribute) {
    const std::string name = lower_case(attribute);
    if (name == "_radius") return 1;
    return name == "_diameter" || name == "_width" || name == "_thickness" ? 0.5 : 0;
}

void add_line_radii(GltfDocument& document, std::size_t mesh, std::size_t number) {
    const auto primitive = [&]() -> Json& { return document.json["meshes"][mesh]["primitives"][number]; };
    const std::string place = primitive_place(mesh, number);
    const std::size_t mode = whole_number(primitive(), "mode", place, 4);
    if (mode < 1 || mode > 3 || !primitive().at("attributes").contains("POSITION")) return;
    const Json& attributes = primitive()["attributes"];
    for (const auto& [name, accessor] : attributes.items()) {
        const double factor = radius_factor(name);
        if (factor == 0) continue;
        const std::size_t count =
            count_of(document, attributes["POSITION"], {place + ": POSITION", "VEC3", GltfNumbers::any});
        const std::vector<double> values =
            values_of(document, accessor, {place + ": " + name, "SCALAR", GltfNumbers::any});
        if (values.size() != count)
            throw std::out_of_range(place + ": " + name + " has " + counted(values.size(), "number", "numbers") +
                                    ", expected one for each of " + counted(count, "vertex", "vertices"));
        std::vector<float> radius;
        for (const double value : values) radius.push_back(float(factor * value));
        const std::size_t added = add_floats(document, radius, "SCALAR", false); // moves what the references above name
        primitive()["attributes"]["TEXCOORD_0"] = added;
        return;
    }
}

} // namespace

GltfJoints cut_down(GltfDocument& document) {
    GltfJoints found;
    Json& json = document.json;
    if (!json.contains("nodes")) json["nodes"] = Json::array();
    found.joint.assign(json["nodes"].size(), false);
    for (std::size_t s = 0; s < entries_of(json, "skins"); ++s)
        for (const Json& joint : json["skins"][s].at("joints")) {
            found.joint[checked_index(joint, "a joint of skin " + std::to_string(s), found.joint.size())] = true;
            found.any = true;
        }
    found.own = own_rods(json["nodes"]);
    add_missing_scene(json);
    found.other_scenes = json["scenes"].size() - 1;
    const Json used = json.value("extensionsUsed", Json::array());
    const bool quantized = std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
    found.mesh_encoded = any_encoded(json, quantized);
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
    check_arrays(document, quantized);
    add_missing_matrices(document);
    weights_as_floats(document);
    for (std::size_t m = 0; m < entries_of(json, "meshes"); ++m) {
        json["meshes"][m].erase("weights");
        for (std::size_t p = 0; p < json["meshes"][m].at("primitives").size(); ++p) {
            json["meshes"][m]["primitives"][p].at("attributes").erase("TEXCOORD_0");
            add_line_radii(document, m, p);
            keep_geometry(json["meshes"][m]["primitives"][p]);
        }
    }
    return found;
}

} // namespace bough
