// mesh_measure.h: how much leaf a mesh is: its area as sheets, and of how many pieces it is.
#pragma once
#include "lib/base/math.h"
#include <array>
#include <vector>

namespace bough {

struct MeshMeasure {
    double area = 0;         // one side of each sheet: a piece that encloses a volume counts half of its surface
    std::int32_t pieces = 0; // connected, points in one place being one
};

// Triangles of indices within `point`. O(n log n).
MeshMeasure measured(const std::vector<Vec3>& point, const std::vector<std::array<std::int32_t, 3>>& triangle);

} // namespace bough
