// speedtree_corners.h: lists of points, vertex records and corners of a SpeedTree element as the vertices of surfaces (private to
// speedtree_mesh.cpp).
#pragma once
#include "speedtree_fields.h"
#include "speedtree_surface.h"
#include <unordered_map>

namespace bough::speedtree {

using IndexOf = std::unordered_map<std::int64_t, std::int32_t>; // of an ID

// The vertex records of an element: what of each is given.
struct Records {
    std::size_t count = 0;
    std::vector<float> normal[3], tangent[3], binormal[3], color[4];
    std::vector<std::array<std::vector<float>, 2>> uv;
    std::vector<std::int32_t> bone; // indices
};
// `vertices` may be absent. `points`: how many there are, which is how many records there are where neither Count nor a list says.
// Throws InputError for lists of unequal length and bones that do not exist.
Records read_records(const pugi::xml_node& vertices, std::size_t points, const IndexOf& bones, const Fields&);

// Corners of one material: pairs of a point and a record, three a triangle.
struct Corners {
    std::int32_t material = -1;
    std::vector<std::int32_t> point, record; // record: empty where records go with points
};

// One vertex for each pair that differs. Gives normals, tangents and colours as the records have them, normals and tangents of unit length; of those
// without a bone that of their piece. `linear`: of normals and tangents; a mirror turns the triangles.
Surface surface_of(const std::vector<Eigen::Vector3f>& points, const Records&, const Corners&, const Mat3& linear);

// The bone of most records of each connected piece, for those that have none. Pieces are joined by points.
void fill_bones(std::size_t points, const std::vector<Corners>&, Records&);

} // namespace bough::speedtree
