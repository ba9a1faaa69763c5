// speedtree_surface.h: a surface of a SpeedTree file (speedtree_mesh.h reads it).
#pragma once
#include "lib/base/math.h"
#include <array>
#include <cstdint>
#include <vector>

namespace bough::speedtree {

// Vertices and triangles of one material.
struct Surface {
    std::int32_t material = -1;                    // index, -1: the file names none
    std::int32_t object = -1;                      // of objects: index
    std::vector<Eigen::Vector3f> position, normal; // normal: unit, or empty: the file has none
    // Unit, along u; then the sign that makes normal x tangent the binormal; or empty
    std::vector<std::array<float, 4>> tangent;
    std::vector<std::vector<std::array<float, 2>>> uv; // sets
    std::vector<std::array<float, 4>> color;           // or empty
    std::vector<std::int32_t> bone;                    // index, -1: none
    std::vector<std::array<std::int32_t, 3>> triangle;
};

} // namespace bough::speedtree
