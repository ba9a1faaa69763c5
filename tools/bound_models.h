// bound_models.h: the mesh of a run whose trees are of files that have meshes of their own.
#pragma once
#include "formats/models/speedtree_model.h"
#include "setting.h"
#include <functional>

namespace bough {

using Bodies = std::vector<std::int32_t>; // rising

struct FileModel {
    SpeedtreeModel model;
    std::vector<std::size_t> trees; // of the scene that are of the file; of a tree that is alone: 0
};

// What shows no file's mesh.
struct OtherTrees {
    Bodies elsewhere;            // rising; of these the mesh is made elsewhere
    std::vector<TreeLook> looks; // of each tree of the scene; none: all look as `shown` does
};

// Each tree shows its file's mesh where the scene puts it. To what is none of theirs (other trees, balls) `made` gives meshes, to trees that look
// alike together. Trees of one file share materials, images and shapes. shown: all of the run's trees, and balls behind them. O(vertices, times
// pieces of a branch).
// Throws as bound_to does.
OwnMesh bound_mesh(std::vector<FileModel>, const Tree& shown, const Setting&, const OtherTrees&,
                   const std::function<OwnMesh(const Tree&)>& made, std::vector<std::string>& notes);

// Where a mesh's shapes and materials stand in the one that it is put into.
struct SharedParts {
    std::size_t shape, material;
};
// Puts materials, images and shapes of a mesh behind another's; its parts stay with it.
SharedParts share(OwnMesh& to, OwnMesh& more);
// Then its parts, as often as there are trees of it. bodies: of each body that they are bound to, its number among all.
void add_parts(OwnMesh& to, OwnMesh&& more, const SharedParts& at, const Bodies& bodies);

} // namespace bough
