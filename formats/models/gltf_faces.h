// gltf_faces.h: points and faces of a glTF primitive (private to this folder).
#pragma once
#include "gltf_document.h"
#include "lib/base/math.h"

namespace bough {

struct GltfFaces {
    std::size_t each = 0;             // corners of a face: 3, 2 or, for points, 0
    std::vector<std::int32_t> corner; // of all, one face after another; none for points
};

// Triangles and lines of any mode: strips, fans and loops are taken apart. `points`: how many the primitive has, all of
// them in their order where it names none. O(indices). Throws as values_of does (gltf_accessor.h).
GltfFaces faces_of(const GltfDocument&, const nlohmann::ordered_json& primitive, const std::string& place,
                   std::size_t points);

// POSITION, as its numbers stand for (KHR_mesh_quantization), in the mesh's own axes. O(points). Throws as values_of does.
std::vector<Vec3> points_of(const GltfDocument&, const nlohmann::ordered_json& primitive, const std::string& place);

// The sets of JOINTS_n and WEIGHTS_n that a primitive names one or both of: "0", "1" and so on, in order. O(attributes).
std::vector<std::string> joint_sets(const nlohmann::ordered_json& attributes);

} // namespace bough
