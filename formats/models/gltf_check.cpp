#include "gltf_check.h"
#include "formats/plain_text.h"
#include "gltf_accessor.h"
#include "gltf_faces.h"
#include "gltf_uri.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

// The joint of the highest number that moves a vertex of a mesh.
struct HighestJoint {
    double joint = -1; // none
    std::size_t vertex = 0;
    std::string attribute; // with its place
};

void check_count(std::size_t count, std::size_t vertices, const std::string& place) {
    if (count != vertices)
        throw std::out_of_range(place + " has " + counted(count, "element", "elements") +
                                ", expected one for each of " + counted(vertices, "vertex", "vertices"));
}

void check_indices(const GltfDocument& document, const Json& primitive, std::size_t vertices,
                   const std::string& place) {
    if (!primitive.contains("indices")) return;
    const std::size_t mode = whole_number(primitive, "mode", place, 4);
    const char* const drawn = mode == 0 ? "a point" : mode <= 3 ? "a line" : "a triangle";
    for (const double index :
         values_of(document, primitive["indices"], {place + ": indices", "SCALAR", GltfNumbers::indices}))
        if (!(index < double(vertices)))
            throw std::out_of_range(
                place + ": " + drawn + " names vertex " + std::to_string(std::uint64_t(index)) +
                (vertices > 0 ? ", expected 0 to " + std::to_string(vertices - 1) : ", but there is none"));
}

void check_finite(const std::vector<double>& values, const std::string& place, const char* element, std::size_t width) {
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k]))
            throw std::out_of_range(place + ": " + element + " " + std::to_string(k / width) +
                                    " is not finite, expected numbers");
}

void check_joints(const GltfDocument& document, const Json& attributes, std::size_t vertices, const std::string& place,
                  HighestJoint& highest) {
    for (const std::string& set : joint_sets(attributes)) {
        const std::string joints = "JOINTS_" + set, weights = "WEIGHTS_" + set, its_joints = place + ": " + joints,
                          its_weights = place + ": " + weights;
        const bool has_joints = attributes.contains(joints), has_weights = attributes.contains(weights);
        if (has_joints != has_weights)
            throw std::out_of_range((has_joints ? its_joints : its_weights) + " comes without " +
                                    (has_joints ? weights : joints));
        if (!has_joints) continue;
        const GltfUse of_joints{its_joints, "VEC4", GltfNumbers::joints},
            of_weights{its_weights, "VEC4", GltfNumbers::weights};
        check_count(count_of(document, attributes[joints], of_joints), vertices, its_joints);
        check_count(count_of(document, attributes[weights], of_weights), vertices, its_weights);
        const std::vector<double> joint = values_of(document, attributes[joints], of_joints),
                                  weight = values_of(document, attributes[weights], of_weights);
        check_finite(weight, its_weights, "vertex", 4);
        for (std::size_t i = 0; i < weight.size(); ++i)
            if (weight[i] < 0)
                throw std::out_of_range(its_weights + ": vertex " + std::to_string(i / 4) +
                                        " has a weight below 0, expected 0 or more");
        for (std::size_t i = 0; i < joint.size(); ++i)
            if (weight[i] > 0 && joint[i] > highest.joint) highest = {joint[i], i / 4, its_joints};
    }
}

void check_finite(const GltfDocument& document, const Json& accessor, const GltfUse& use, const char* element,
                  std::size_t width) {
    check_finite(values_of(document, accessor, use), use.place, element, width);
}

// What a model that is moved keeps of each vertex and no reader of ours looks at: floats in it must be numbers. `attributes`: of a primitive or a
// morph target.
void check_kept(const GltfDocument& document, const Json& attributes, std::size_t vertices, const std::string& place) {
    const std::size_t accessors = entries_of(document.json, "accessors");
    for (const auto& [name, named] : attributes.items()) {
        if (name == "POSITION" || name.starts_with("JOINTS_") || name == "WEIGHTS_0" || name == "WEIGHTS_1") continue;
        const std::string its = place + ": " + valid_utf8(name);
        const Json& array = document.json["accessors"][checked_index(named, its, accessors)];
        const std::string type = array.value("type", std::string());
        const std::size_t width = type == "SCALAR" ? 1
                                  : type == "VEC2" ? 2
                                  : type == "VEC3" ? 3
                                  : type == "VEC4" ? 4
                                                   : 0;
        if (width == 0 || whole_number(array, "componentType", its, 0) != 5126) continue;
        const GltfUse use{its, type.c_str(), GltfNumbers::floats};
        check_count(count_of(document, named, use), vertices, its);
        check_finite(document, named, use, "vertex", width);
    }
}

HighestJoint check_mesh(const GltfDocument& document, std::size_t mesh, bool quantized) {
    HighestJoint highest;
    const Json& primitives = document.json["meshes"][mesh].at("primitives");
    if (primitives.empty())
        throw std::out_of_range("mesh " + std::to_string(mesh) + " has no primitives, expected one or more");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        const std::string place = primitive_place(mesh, p);
        const Json& attributes = primitives[p].at("attributes");
        if (const std::size_t mode = whole_number(primitives[p], "mode", place, 4); mode > 6)
            throw std::out_of_range(place + ": mode is " + std::to_string(mode) + ", expected 0 to 6");
        if (!attributes.contains("POSITION")) continue;
        const std::size_t vertices =
            count_of(document, attributes["POSITION"],
                     {place + ": POSITION", "VEC3", quantized ? GltfNumbers::any : GltfNumbers::floats});
        if (vertices == 0) throw std::out_of_range(place + ": POSITION has no vertices, expected one or more");
        check_finite(document, attributes["POSITION"], {place + ": POSITION", "VEC3", GltfNumbers::any}, "vertex", 3);
        check_indices(document, primitives[p], vertices, place);
        check_joints(document, attributes, vertices, place, highest);
        if (whole_number(primitives[p], "mode", place, 4) >= 4) check_kept(document, attributes, vertices, place);
        const Json targets = primitives[p].value("targets", Json::array());
        for (std::size_t t = 0; t < targets.size(); ++t)
            check_kept(document, targets[t], vertices, place + ", target " + std::to_string(t));
    }
    return highest;
}

void check_skin(const GltfDocument& document, std::size_t number) {
    const Json& skin = document.json["skins"][number];
    if (!skin.contains("inverseBindMatrices")) return;
    const std::string place = "skin " + std::to_string(number) + ": inverseBindMatrices";
    const std::size_t joints = skin.at("joints").size(),
                      count = count_of(document, skin["inverseBindMatrices"], {place, "MAT4", GltfNumbers::floats});
    if (count < joints)
        throw std::out_of_range(place + " has " + counted(count, "matrix", "matrices") + ", expected one for each of " +
                                counted(joints, "joint", "joints"));
    check_finite(document, skin["inverseBindMatrices"], {place, "MAT4", GltfNumbers::floats}, "matrix", 16);
}

void check_texture(const Json& of, const char* key, const std::string& place, std::size_t textures) {
    if (of.contains(key)) index_of(of[key], "index", place + ", " + key, textures);
}

void check_image(const GltfDocument& document, const Json& image, const std::string& place) {
    std::string bytes, type = image.value("mimeType", std::string());
    if (image.contains("bufferView")) {
        const Json& view =
            document
                .json["bufferViews"][index_of(image, "bufferView", place, entries_of(document.json, "bufferViews"))];
        bytes = document.binary.substr(std::min(whole_number(view, "byteOffset", place, 0), document.binary.size()),
                                       32); // enough to know it by
    } else if (const std::string uri = image.value("uri", std::string()); uri.starts_with("data:")) {
        bytes = bytes_of_uri(uri, "");
        if (type.empty()) type = uri.substr(5, uri.find_first_of(";,") - 5);
    } else {
        return;
    }
    if ((type == "image/png" || type == "image/jpeg") && !image_type(bytes))
        throw std::out_of_range(place + " is no image that can be read, expected " + type);
}

} // namespace

void check_materials(const GltfDocument& document) {
    const Json& json = document.json;
    const std::size_t textures = entries_of(json, "textures"), materials = entries_of(json, "materials");
    for (std::size_t m = 0; m < entries_of(json, "meshes"); ++m)
        for (std::size_t p = 0; p < json["meshes"][m].at("primitives").size(); ++p)
            if (const Json& primitive = json["meshes"][m]["primitives"][p]; primitive.contains("material"))
                index_of(primitive, "material", primitive_place(m, p), materials);
    for (std::size_t k = 0; k < materials; ++k) {
        const Json& material = json["materials"][k];
        const std::string place = "material " + std::to_string(k);
        for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
            check_texture(material, key, place, textures);
        if (!material.contains("pbrMetallicRoughness")) continue;
        for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"})
            check_texture(material["pbrMetallicRoughness"], key, place, textures);
    }
    for (std::size_t k = 0; k < textures; ++k)
        if (json["textures"][k].contains("source"))
            index_of(json["textures"][k], "source", "texture " + std::to_string(k), entries_of(json, "images"));
    for (std::size_t k = 0; k < entries_of(json, "images"); ++k)
        check_image(document, json["images"][k], "image " + std::to_string(k));
}

void check_arrays(const GltfDocument& document) {
    const Json& json = document.json;
    const Json used = json.value("extensionsUsed", Json::array());
    const bool quantized = std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
    const std::size_t meshes = entries_of(json, "meshes"), skins = entries_of(json, "skins");
    std::vector<HighestJoint> highest;
    for (std::size_t m = 0; m < meshes; ++m) highest.push_back(check_mesh(document, m, quantized));
    for (std::size_t s = 0; s < skins; ++s) check_skin(document, s);
    for (std::size_t i = 0; i < entries_of(json, "nodes"); ++i) {
        const Json& node = json["nodes"][i];
        const std::string of_node = " of node " + std::to_string(i);
        if (!node.contains("mesh")) continue;
        const HighestJoint& moved = highest[checked_index(node["mesh"], "the mesh" + of_node, meshes)];
        if (!node.contains("skin")) continue;
        const std::size_t skin = checked_index(node["skin"], "the skin" + of_node, skins),
                          joints = json["skins"][skin].at("joints").size();
        if (moved.joint >= double(joints))
            throw std::out_of_range(moved.attribute + " has joint " + std::to_string(std::uint64_t(moved.joint)) +
                                    " move vertex " + std::to_string(moved.vertex) + ", but skin " +
                                    std::to_string(skin) + " has " + counted(joints, "joint", "joints"));
    }
}

} // namespace bough
