// imported_parts.h: branches and leaves as a reader of a foreign format finds them, in the file's own unit and axes.
#pragma once
#include "lib/base/math.h"
#include <cstdint>
#include <vector>

namespace bough {

struct ImportedBranch {
    std::int32_t parent = -1;   // index into ImportedTree::branches, in any order, no cycles; -1: on the ground
    double parent_at = 0;       // fraction of the parent's arc length
    std::vector<Vec3> point;    // [file unit] base to tip; the first is the joint
    std::vector<double> radius; // [file unit] one per point
};

struct ImportedLeaf {
    std::int32_t branch = -1;     // -1: the nearest branch
    Vec3 position = Vec3::Zero(); // [file unit]
    Mat3 axes = Mat3::Identity(); // columns in file axes: x width, y normal, z length; a rotation
    double length = 0, width = 0; // [file unit]
    double area = 0;              // [file unit squared] one side of its sheets, where it has a mesh that tells; else 0
    std::int32_t pieces = 0;      // of that mesh
};

} // namespace bough
