// speedtree_leaves.h: leaf references of a SpeedTree file as leaves.
//
// Positions are in the tree's frame (leaf objects have Abs 0). RotAngle is in degrees about RotAxis, right-handed, and
// turns the mesh into the tree's frame: with that reading the long axis of every leaf mesh of the known files points
// outward along its bone (mean cosine 0.87), with the inverse or with radians it points anywhere. Vertices of the mesh
// are normalized, Scale is their size in the unit of the positions (1 in a file in metres, 100 in the same tree in
// centimetres); OriginalScale, the size the mesh had where it was modelled, takes no part.
#pragma once
#include "imported_tree.h"
#include "speedtree_xml.h"

namespace bough::speedtree {

// What a mesh makes of a leaf, for Scale 1: length along the mesh axis that reaches farthest from its origin, normal along
// the thinner of the other two; length is that reach, width the mesh's extent across.
struct LeafShape {
    Mat3 axes; // columns in mesh axes: x width, y normal, z length
    double length, width;
    double area = 0;         // one side of its sheets (mesh_measure.h); 0: not known
    std::int32_t pieces = 0; // leaves, and what bears them
};
// Nothing for a mesh without extent in two directions.
std::optional<LeafShape> shape_of(const Mesh&);

// One leaf per reference, a twig mesh too, which imported_tree.h makes a twig. branch_of holds the branch of each reference, -1: the nearest. A
// reference without a mesh that has a shape becomes 1 long (along y) and 0.5 wide, times Scale, with a note, as are references of Scale 0, which are
// left out. O(leaves).
std::vector<ImportedLeaf> leaves_of(const File&, const std::vector<std::int32_t>& branch_of, ImportNotes&);

} // namespace bough::speedtree
