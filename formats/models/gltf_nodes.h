// gltf_nodes.h: where the nodes of a glTF document stand (private to this folder).
#pragma once
#include "lib/base/math.h"
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace bough {

struct GltfNodes {
    std::vector<std::int32_t> parent; // -1: none
    std::vector<Eigen::Affine3d> local, world;
    // Rotations of a node and all above it, without their scales but for what `flipped` has of them
    std::vector<Quat> turned;
    std::vector<Quat> flipped;   // of each node's own scale: what its signs turn, all three mirrored or none
    std::vector<double> unequal; // of each node's own scale: largest over least, less 1
};
// O(nodes). Throws InputError: a node that is its own ancestor or has two parents, numbers that are wrong.
GltfNodes nodes_of(const nlohmann::ordered_json&, const std::string& name);

// Numbers of the nodes in the default scene, depth first, parents first, each list in its order. O(nodes). Throws
// std::out_of_range for a node that is not there or stands in the scene twice; Json exceptions for types that are wrong.
std::vector<std::size_t> nodes_in_scene(const nlohmann::ordered_json&);

// The nearest rotation, and what it leaves along its own axes (negative for a mirror); identity for a singular matrix.
void part(const Mat3& linear, Quat& rotation, Vec3& scale);

} // namespace bough
