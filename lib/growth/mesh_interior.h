// mesh_interior.h: whether a point lies inside a triangle mesh.
//
// A ray along each of the six axis directions is followed from the point; it counts the triangles crossed, each with
// the sign of its facing. Where the mesh is closed and its triangles face alike, a ray whose count is not zero votes
// "inside": overlapping closed parts unite, inner shells that face the other way are hollows, and it does not matter
// whether the whole faces in or out. Else a ray that crosses an odd number votes "inside". Four votes of six decide, so
// that a hole is bridged where most rays miss it.
// A ray through an edge or a corner is counted right, once: its place is compared with each edge by the same rounded
// number whichever of the two triangles asks (a half-open rule on the projected triangles).
// Triangles are sorted into a grid over each axis' projection: making it is O(triangles), a query takes the triangles of
// three cells, a handful. Corners at equal positions are one.
// A line through a crown of leaves crosses some 10 of them (its leaf area index is of that size), a line through a shell 2. Where the corners of the
// triangles are out of order, each spans the whole: a line crosses a tenth of all of them, a query takes as long, and what is inside means nothing.
// So a mesh whose lines cross more than `most_crossings`, and a fiftieth of all, on average is refused.
#pragma once
#include "../base/math.h"
#include <array>
#include <vector>

namespace bough {

using Triangle = std::array<std::int32_t, 3>; // corners

struct MeshClosure {
    std::int64_t triangles = 0;  // with an area
    std::int64_t open_edges = 0; // that an odd number of triangles share
    bool alike = false;          // closed, and each edge is run through as often one way as the other
    double volume = 0;           // [m^3] by the divergence theorem, as drawn; of meaning where `alike`
    double crossings = 0;        // triangles that a line through the bounding box along an axis crosses, the mean
};

class MeshInterior {
public:
    static constexpr double most_crossings = 100;
    // Throws std::invalid_argument for a corner that does not exist, positions that are not finite, no triangle with an area, or corners that are
    // out of order (more crossings than most_crossings and than a fiftieth of the triangles).
    MeshInterior(const std::vector<Vec3>& vertex, const std::vector<Triangle>&);
    bool contains(const Vec3&) const;
    const Vec3& lower() const { return lower_; } // [m] corners of the bounding box
    const Vec3& upper() const { return upper_; }
    const MeshClosure& closure() const { return closure_; }

private:
    struct Crossings {
        int above = 0, below = 0; // signed where the mesh is alike, else their number
    };
    struct Plane { // the grid over the projection along axis a: u = a + 1, v = a + 2 (mod 3)
        int columns = 1, rows = 1;
        double u0 = 0, v0 = 0, u_cell = 1, v_cell = 1;
        std::vector<std::int32_t> first, triangle; // first: columns * rows + 1
        int column(double u) const;
        int row(double v) const;
    };
    void weld(const std::vector<Vec3>&, const std::vector<Triangle>&);
    void measure();
    void count_crossings();
    Plane plane(int axis) const;
    bool fill(Plane&, int axis, std::size_t most) const;
    Crossings cross(const Vec3&, int axis) const;

    std::vector<Vec3> vertex_;
    std::vector<Triangle> triangle_;
    Vec3 lower_, upper_;
    MeshClosure closure_;
    std::array<Plane, 3> plane_;
};

} // namespace bough
