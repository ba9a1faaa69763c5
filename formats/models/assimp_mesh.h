// assimp_mesh.h: triangles as assimp gives them, for envelope_mesh.h alone, which calls this in a child process.
#pragma once
#include "lib/growth/mesh_interior.h"
#include "model_kind.h"
#include <string>
#include <string_view>

namespace bough {

struct AssimpMesh {
    std::vector<Vec3> vertex; // [file unit], axes of the file, nodes' transforms applied
    std::vector<Triangle> triangle;
    Mat3 axes = Mat3::Identity(); // to x right, y up, z to the viewer, from the file's own statement
    double unit = 0;              // [m] 0: the file states none
};

// assimp applies COLLADA's unit by itself, and its axis too unless `up_given`. Throws std::runtime_error with assimp's
// message. May crash on a damaged file.
AssimpMesh read_by_assimp(std::string_view content, AssimpKind, bool up_given);

// As bytes, and back.
std::string packed(const AssimpMesh&);
AssimpMesh unpacked(const std::string&);

} // namespace bough
