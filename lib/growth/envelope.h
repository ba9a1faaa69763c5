// envelope.h: the volume that a tree of colonize.h fills: a sphere, cone or box in closed form, or a closed mesh.
//
// The closed forms stand upright on `base`, the middle of their bounding box's lower face, `size` wide along x, y, z: an
// ellipsoid, an elliptic cone with its apex up, a box. A mesh stands where its vertices are.
#pragma once
#include "mesh_interior.h"
#include "random.h"
#include <memory>

namespace bough {

enum class EnvelopeShape : std::uint8_t { sphere, cone, box, mesh };

struct Envelope {
    EnvelopeShape shape = EnvelopeShape::sphere;
    Vec3 size = {6, 6, 6};                    // [m] > 0; not of a mesh
    Vec3 base = {0, 1.8, 0};                  // [m] not of a mesh
    std::shared_ptr<const MeshInterior> mesh; // of a mesh alone; shared, so that copies are cheap
    double space = 0;                         // [m^3] volume() of a mesh, where it has been asked for; else 0
};

// Throws std::invalid_argument naming what is wrong: sizes, a missing mesh.
void check_envelope(const Envelope&);

Vec3 lower_corner(const Envelope&); // [m] of the bounding box
Vec3 upper_corner(const Envelope&);

// O(1); of a mesh as in mesh_interior.h.
bool contains(const Envelope&, const Vec3&);

// Point `index` of those drawn uniformly from the inside for `key`; equal for any number of points. Closed forms map
// three uniform numbers; of a mesh points of the box are drawn until one is inside. Throws std::invalid_argument where
// none of 1e6 is.
Vec3 point_inside(const Envelope&, RandomKey key, std::uint64_t index);

// [m^3] Closed forms exactly; of a mesh `space`, else the share of 2^15 points of the box (a low-discrepancy sequence), about 1 %.
double volume(const Envelope&);

} // namespace bough
