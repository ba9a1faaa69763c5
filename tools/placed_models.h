// placed_models.h: a scene's trees that show skinned models, each its file's, moved by the model's bones; beside them what the scene's other trees
// show.
#pragma once
#include "baked_sinks.h"
#include "bound_models.h"
#include "formats/models/driven_forest.h"
#include "skin_mover.h"

namespace bough {

struct SkinnedFile {
    UserModel model;
    std::vector<std::size_t> trees; // of the scene that are of the file
};

// A tree that shows a model.
struct PlacedTree {
    DrivenStand stand;
    Bodies bodies; // its, of the run's
};

struct PlacedFile {
    UserModel model;
    std::vector<PlacedTree> tree;
};

// shown: all of the run's trees, and balls behind them.
std::vector<PlacedFile> placed_files(std::vector<SkinnedFile>, const Tree& shown, const Setting&);

// The bodies of its trees.
Bodies bodies_of(const PlacedFile&);

// Of each tree the mesh, which its bones move. file: which of the files it is of.
struct PlacedMesh {
    DrivenMesh mesh;
    Bodies bodies;
    std::size_t file;
};
// Notes: of each file once. Throws as DrivenMesh does.
std::vector<PlacedMesh> meshes_of(PlacedFile, std::size_t file, std::vector<std::string>& notes);
std::size_t bones_of(const std::vector<PlacedMesh>&);

// What a scene shows beside them: bound to all of the run's bodies, of which it moves those that are left; no parts where none are.
struct OtherMesh {
    OwnMesh mesh;
    Bodies bodies; // that are left
};

// others: what bound_mesh made; elsewhere: the bodies that the models move, rising, of so many in all.
OtherMesh other_mesh(OwnMesh others, const Bodies& elsewhere, std::size_t bodies);

// All of it as one mesh, of which the models' parts stand last.
MovedMesh moved(std::vector<PlacedMesh>, OtherMesh, const Tree& shown);
// As one rig. Keeps a reference to the notes.
RiggedMesh rigged(const std::vector<PlacedMesh>&, OtherMesh, const Tree& shown, const GltfChoice&,
                  std::vector<std::string>& notes);

// One .glb: the models with nodes, skins and materials of their own, behind what the others show. bodies: of each forest's trees. Keeps a reference
// to the notes.
struct PlacedForest {
    DrivenForest forest;
    std::vector<Bodies> bodies;
};
PlacedForest forest_of(PlacedFile, const DrivenOptions&, std::vector<std::string>& notes);
std::unique_ptr<FrameSink> forest_sink(const std::string& file, std::vector<PlacedForest>, OtherMesh, const Tree& shown,
                                       double fps, const GltfChoice&, const std::string& source,
                                       std::vector<std::string>& notes);

} // namespace bough
