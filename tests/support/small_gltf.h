// small_gltf.h: a glTF of two joints and four vertices, written byte by byte and changed at will, and what its readers must give or say. What they
// must give follows from the format: a vertex is moved by its joints' world matrices, weighted.
#pragma once
#include "formats/models/model_scene.h"
#include "import_support.h"
#include <functional>
#include <nlohmann/json.hpp>

namespace small_gltf {

using namespace bough;
using namespace bough::test;
using Json = nlohmann::ordered_json;

// A buffer of the bytes that pairs of hexadecimal digits stand for; blanks part them.
inline Json buffer(const std::string& hex) {
    std::string digits, uri = "data:application/octet-stream,";
    for (const char c : hex)
        if (c != ' ') digits += c;
    for (std::size_t k = 0; k < digits.size(); k += 2) uri += "%" + digits.substr(k, 2);
    return {{"byteLength", digits.size() / 2}, {"uri", uri}};
}

// Views, buffers and accessors of the file below go by these numbers.
enum Array : std::size_t { position, joints, weights, indices };

inline const std::string one = "0000803F ", zero = "00000000 ", half = "0000003F ";

// Two joints, at (0, 0, 0) and (0, 1, 0); a skin without matrices, so that each moves a vertex by its place; and two
// triangles of four vertices on x, of which the joints take all, 1/2, nothing and nothing to the first of the two.
inline Json skinned() {
    Json json = Json::parse(R"({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0, 2]}],
        "nodes": [{"children": [1]}, {"translation": [0, 1, 0]}, {"mesh": 0, "skin": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}]}],
        "skins": [{"joints": [0, 1]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5121, "count": 4, "type": "VEC4"},
                      {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"},
                      {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 1, "byteLength": 16},
                        {"buffer": 2, "byteLength": 64}, {"buffer": 3, "byteLength": 12}]})");
    json["buffers"] = {buffer(zero + zero + zero + half + zero + zero + one + zero + zero + "00000040" + zero + zero),
                       buffer("00010000 00010000 00010000 01000000"),
                       buffer(one + zero + zero + zero + half + half + zero + zero + zero + one + zero + zero + one +
                              zero + zero + zero),
                       buffer("0000 0100 0200 0200 0100 0300")};
    return json;
}

inline const std::vector<Vec3> moved{{0, 0, 0}, {0.5, 0.5, 0}, {1, 1, 0}, {2, 1, 0}};

using Change = std::function<void(Json&)>;

inline std::string changed(const Change& change) {
    Json json = skinned();
    change(json);
    return json.dump();
}

inline ModelScene scene_of(const std::string& content) {
    ImportOptions options;
    options.name = "s.gltf";
    return read_model(content, AssimpKind::gltf, options);
}

// The file's vertices as the joints move them.
inline void reads(const Change& change, const std::vector<Vec3>& expected = moved) {
    const ModelScene scene = scene_of(changed(change));
    REQUIRE(scene.vertex.size() == expected.size());
    for (std::size_t v = 0; v < expected.size(); ++v) {
        INFO(v << ": " << scene.vertex[v].transpose());
        CHECK(near(scene.vertex[v], expected[v], 1e-6));
    }
    CHECK(scene.triangles == 2);
}

inline void refuses(const Change& change, const std::string& text) {
    std::string error;
    try {
        scene_of(changed(change));
    } catch (const InputError& e) {
        error = e.what();
    }
    INFO("expected: " << text);
    CHECK(error == "s.gltf: is no glTF 2.0: " + text);
}

inline Json& accessor(Json& json, std::size_t array) {
    return json["accessors"][array];
}
inline Json& view(Json& json, std::size_t array) {
    return json["bufferViews"][array];
}
inline Json& attributes(Json& json) {
    return json["meshes"][0]["primitives"][0]["attributes"];
}
inline void put(Json& json, std::size_t array, int component, const std::string& hex) {
    json["buffers"][array] = buffer(hex);
    view(json, array)["byteLength"] = json["buffers"][array]["byteLength"];
    accessor(json, array)["componentType"] = component;
}

// The same weights of joints 0 and 1 for the first three vertices, of 1 and 0 for the last.
inline Change weighted(int component, const std::string& element, bool normalized) {
    return [=](Json& json) {
        put(json, weights, component, element + element + element + element);
        if (normalized) accessor(json, weights)["normalized"] = true;
    };
}

} // namespace small_gltf
