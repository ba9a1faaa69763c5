// speedtree_model.h: the mesh of a SpeedTree file, to be moved by the tree that was made of the file.
//
// A vertex of an object is bound to the branch that its BoneID's bone lies along, else to that of its object's spine (or of the nearest
// object above that has one), else to the nearest wood; where on that branch, and to which two of its pieces, wood_axes.h says. A leaf
// reference moves with its leaf, in the order of the file (a clump bends, OwnPlace::foot); where the tree has no such leaf body at its place, with
// the piece of wood that bears it. Its shape is the mesh it names, at the level of detail it names, else the mesh's first.
#pragma once
#include "formats/error.h"
#include "formats/exports/own_mesh.h"
#include "formats/imports/import.h"
#include "formats/imports/speedtree_mesh.h"

namespace bough {

struct Tree;

struct SpeedtreeModel {
    std::string name; // in messages
    speedtree::File file;
    speedtree::MeshFile mesh;                            // standing surfaces in the tree's world [m]
    Eigen::Affine3d world = Eigen::Affine3d::Identity(); // from the file
    OwnMesh shown;                                       // its materials, and nothing else yet
};

// No object of the file has triangles.
struct NoOwnMesh : InputError {
    explicit NoOwnMesh(const std::string& name, const std::string& advice = "");
    std::string name;
};

// Whether a file is one, and has a mesh in its objects. Looks at its head, and for its first triangles.
bool has_speedtree_mesh(std::string_view content);

// `found`: what an import of the file told of its unit, axes and place. The content must stay readable until it returns; `taken_in` as in
// import.h. Throws NoOwnMesh; InputError: all that parse() and parse_mesh() refuse, a texture that is no image.
SpeedtreeModel read_speedtree_model(std::string_view content, const std::string& path, const ImportNotes& found,
                                    ImportNotes& notes, const std::function<void()>& taken_in = {});

// Bound to the tree, which stands at `place` in the world (from where an import puts it). Throws InputError where most bones and spines
// lie beside the tree, or it is less than half or more than twice as large. O(vertices, times pieces of a branch).
OwnMesh bound_to(SpeedtreeModel, const Tree&, const Eigen::Affine3d& place, std::vector<std::string>& notes);

} // namespace bough
