// bound_models.h: the mesh of a run whose trees are of files that have meshes of their own.
#pragma once
#include "formats/models/speedtree_model.h"
#include "setting.h"
#include <functional>

namespace bough {

struct FileModel {
    SpeedtreeModel model;
    std::vector<std::size_t> trees; // of the scene that are of the file; of a tree that is alone: 0
};

// Each tree shows its file's mesh where the scene puts it. What is none of theirs (other trees, balls) is a tree by itself, which `made` gives a mesh. Trees of one
// file share materials, images and shapes. shown: all of the run's trees, and balls behind them. O(vertices, times pieces of a branch). Throws as bound_to does.
OwnMesh bound_mesh(std::vector<FileModel>, const Tree& shown, const Setting&,
                   const std::function<OwnMesh(const Tree&)>& made, std::vector<std::string>& notes);

} // namespace bough
