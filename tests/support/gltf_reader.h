// gltf_reader.h: a .glb read by the specification alone, for tests: chunks, accessors, node transforms, skinning, keys.
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gltf_reader {

using Json = nlohmann::json;
using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Glb {
    Json json;
    std::string binary;
};

inline std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    REQUIRE(at + 4 <= bytes.size());
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

inline Glb parse(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 4) == "glTF");
    REQUIRE(word(bytes, 4) == 2);
    REQUIRE(word(bytes, 8) == bytes.size());
    const std::size_t json_size = word(bytes, 12);
    REQUIRE(json_size % 4 == 0);
    REQUIRE(bytes.substr(16, 4) == "JSON");
    const std::size_t binary_size = word(bytes, 20 + json_size);
    REQUIRE(binary_size % 4 == 0);
    REQUIRE(bytes.substr(24 + json_size, 4) == std::string("BIN\0", 4));
    REQUIRE(28 + json_size + binary_size == bytes.size());
    Glb glb{Json::parse(bytes.substr(20, json_size)), bytes.substr(28 + json_size)};
    REQUIRE(glb.json["buffers"][0]["byteLength"] == binary_size);
    return glb;
}

inline std::size_t components(const Json& accessor) {
    const std::string type = accessor["type"];
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

inline std::size_t component_size(const Json& accessor) {
    const int type = accessor["componentType"];
    return type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
}

// All numbers of an accessor, one row after another. Alignment, stride and limits of its view are checked.
inline std::vector<double> numbers(const Glb& glb, std::size_t index) {
    const Json& accessor = glb.json["accessors"][index];
    const Json& view = glb.json["bufferViews"][std::size_t(accessor["bufferView"])];
    const std::size_t n = accessor["count"], width = components(accessor), size = component_size(accessor);
    const std::size_t stride = view.value("byteStride", width * size), first = accessor.value("byteOffset", 0u);
    const std::size_t view_first = view["byteOffset"], view_size = view["byteLength"];
    REQUIRE(n > 0);
    REQUIRE((view_first + first) % 4 % size == 0);
    REQUIRE(stride % size == 0);
    REQUIRE(first + (n - 1) * stride + width * size <= view_size);
    REQUIRE(view_first + view_size <= glb.binary.size());
    std::vector<double> all;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < width; ++k) {
            const char* at = glb.binary.data() + view_first + first + i * stride + k * size;
            if (accessor["componentType"] == 5126) {
                float value;
                std::memcpy(&value, at, 4);
                all.push_back(double(value));
            } else if (accessor["componentType"] == 5122) {
                std::int16_t value;
                std::memcpy(&value, at, 2);
                all.push_back(accessor.value("normalized", false) ? std::max(value / 32767.0, -1.0) : value);
            } else {
                std::uint32_t value = 0;
                std::memcpy(&value, at, size);
                all.push_back(accessor.value("normalized", false) ? value / (size == 1 ? 255.0 : 65535.0) : value);
            }
        }
    return all;
}

inline Quaterniond quaternion(const double* x) {
    return Quaterniond(x[3], x[0], x[1], x[2]);
}

// slerp at a time between the keys of a sampler, its ends outside them.
inline Quaterniond sample(const std::vector<double>& times, const std::vector<double>& values, double time) {
    const std::size_t after = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (after == 0) return quaternion(&values[0]);
    const Quaterniond a = quaternion(&values[4 * (after - 1)]);
    if (after == times.size()) return a;
    const double t = (time - times[after - 1]) / (times[after] - times[after - 1]);
    return a.slerp(t, quaternion(&values[4 * after]));
}

// World matrices of all nodes at a time (before the animation if negative).
inline std::vector<Matrix4d> node_matrices(const Glb& glb, double time) {
    const Json& nodes = glb.json["nodes"];
    std::vector<Vector3d> place(nodes.size(), Vector3d::Zero());
    std::vector<Quaterniond> turn(nodes.size(), Quaterniond::Identity());
    std::vector<Matrix4d> scale(nodes.size(), Matrix4d::Identity()); // or the whole of a node that has a matrix
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].contains("translation"))
            place[i] = Vector3d(nodes[i]["translation"][0], nodes[i]["translation"][1], nodes[i]["translation"][2]);
        if (nodes[i].contains("matrix")) {
            const std::vector<double> m = nodes[i]["matrix"];
            scale[i] = Eigen::Map<const Matrix4d>(m.data());
        }
        for (int k = 0; k < 3 && nodes[i].contains("scale"); ++k) scale[i](k, k) = nodes[i]["scale"][std::size_t(k)];
        if (!nodes[i].contains("rotation")) continue;
        const std::vector<double> q = nodes[i]["rotation"];
        turn[i] = quaternion(q.data());
    }
    if (time >= 0) {
        const Json& animation = glb.json["animations"][0];
        for (const Json& channel : animation["channels"]) {
            const Json& sampler = animation["samplers"][std::size_t(channel["sampler"])];
            if (channel["target"]["path"] == "translation") { // at a frame: the nearest key
                const std::vector<double> times = numbers(glb, sampler["input"]), at = numbers(glb, sampler["output"]);
                REQUIRE(at.size() == 3 * times.size());
                std::size_t key = 0;
                while (key + 1 < times.size() && std::abs(times[key + 1] - time) < std::abs(times[key] - time)) ++key;
                place[std::size_t(channel["target"]["node"])] = Vector3d(at[3 * key], at[3 * key + 1], at[3 * key + 2]);
                continue;
            }
            if (channel["target"]["path"] == "weights") continue; // morph_weights
            REQUIRE(channel["target"]["path"] == "rotation");
            turn[std::size_t(channel["target"]["node"])] =
                sample(numbers(glb, sampler["input"]), numbers(glb, sampler["output"]), time);
        }
    }
    std::vector<Matrix4d> world(nodes.size(), Matrix4d::Identity());
    std::vector<std::size_t> open;
    for (const Json& root : glb.json["scenes"][0]["nodes"]) open.push_back(root);
    std::vector<int> seen(nodes.size(), 0);
    for (const std::size_t root : open)
        world[root] = (Eigen::Translation3d(place[root]) * turn[root]).matrix() * scale[root];
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        REQUIRE(++seen[i] == 1);
        for (const Json& child : nodes[i].value("children", Json::array())) {
            const std::size_t c = child;
            world[c] = world[i] * (Eigen::Translation3d(place[c]) * turn[c]).matrix() * scale[c];
            open.push_back(c);
        }
    }
    CHECK(std::count(seen.begin(), seen.end(), 1) == std::ptrdiff_t(nodes.size()));
    return world;
}

// Of the morph targets of a node's mesh at a time: linear between keys, its ends outside them; before the animation the mesh's own.
inline std::vector<double> morph_weights(const Glb& glb, std::size_t node, double time) {
    const Json& mesh = glb.json["meshes"][std::size_t(glb.json["nodes"][node]["mesh"])];
    std::vector<double> weights = mesh.value("weights", std::vector<double>());
    if (time < 0) return weights;
    for (const Json& channel : glb.json["animations"][0]["channels"]) {
        if (channel["target"]["path"] != "weights" || channel["target"]["node"] != node) continue;
        const Json& sampler = glb.json["animations"][0]["samplers"][std::size_t(channel["sampler"])];
        const std::vector<double> times = numbers(glb, sampler["input"]), all = numbers(glb, sampler["output"]);
        REQUIRE(all.size() == weights.size() * times.size());
        const std::size_t after = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
        const std::size_t a = after == 0 ? 0 : after - 1, b = std::min(after, times.size() - 1);
        const double t = a == b ? 0 : (time - times[a]) / (times[b] - times[a]);
        for (std::size_t m = 0; m < weights.size(); ++m)
            weights[m] = (1 - t) * all[weights.size() * a + m] + t * all[weights.size() * b + m];
    }
    return weights;
}

// Adds weight times change of each morph target of a primitive to an attribute of it.
inline void morph(const Glb& glb, const Json& primitive, const std::vector<double>& weights, const char* attribute,
                  std::vector<double>& values) {
    if (!primitive.contains("targets")) return;
    REQUIRE(primitive["targets"].size() == weights.size());
    for (std::size_t m = 0; m < weights.size(); ++m) {
        const std::vector<double> change = numbers(glb, primitive["targets"][m][attribute]);
        REQUIRE(change.size() == values.size());
        for (std::size_t k = 0; k < values.size(); ++k) values[k] += weights[m] * change[k];
    }
}

// Vertices of all primitives of the skinned nodes, one after another, as the skin moves them.
inline std::vector<Vector3d> skinned(const Glb& glb, double time) {
    const std::vector<Matrix4d> world = node_matrices(glb, time);
    const Json& skin = glb.json["skins"][0];
    const std::vector<double> inverse = numbers(glb, skin["inverseBindMatrices"]);
    std::vector<Matrix4d> moved;
    for (std::size_t j = 0; j < skin["joints"].size(); ++j)
        moved.push_back(world[std::size_t(skin["joints"][j])] * Eigen::Map<const Matrix4d>(&inverse[16 * j]));
    std::vector<Vector3d> all;
    std::vector<std::pair<Json, std::vector<double>>> primitives; // with the weights of their targets
    for (std::size_t root = 0; root < glb.json["nodes"].size(); ++root) {
        const Json& node = glb.json["nodes"][root];
        if (!node.contains("skin")) continue;
        for (const Json& primitive : glb.json["meshes"][std::size_t(node["mesh"])]["primitives"])
            primitives.push_back({primitive, morph_weights(glb, root, time)});
    }
    for (const auto& [primitive, weights] : primitives) {
        const Json& attributes = primitive["attributes"];
        std::vector<double> position = numbers(glb, attributes["POSITION"]);
        morph(glb, primitive, weights, "POSITION", position);
        const std::vector<double> joint = numbers(glb, attributes["JOINTS_0"]);
        const std::vector<double> weight = numbers(glb, attributes["WEIGHTS_0"]);
        for (std::size_t v = 0; v < position.size() / 3; ++v) {
            Eigen::Vector4d at = Eigen::Vector4d::Zero();
            for (std::size_t k = 0; k < 4; ++k)
                at +=
                    weight[4 * v + k] * (moved[std::size_t(joint[4 * v + k])] *
                                         Eigen::Vector4d(position[3 * v], position[3 * v + 1], position[3 * v + 2], 1));
            all.push_back(at.head<3>());
        }
    }
    return all;
}

} // namespace gltf_reader
