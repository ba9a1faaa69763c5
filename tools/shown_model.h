// shown_model.h: the model that treesim shows in place of a mesh made from the tree: the one --skin names, or INPUT's own.
#pragma once
#include "placed_models.h"
#include "treesim_options.h"

namespace bough {

struct ShownModel {
    std::optional<UserModel> driven;  // moved by its bones (driven_model.h, driven_mesh.h); then there is no other
    std::vector<FileModel> bound;     // bound to the bodies of trees (speedtree_model.h)
    std::vector<SkinnedFile> skinned; // of a scene: moved by their bones
    std::string failed;               // why INPUT's own model cannot be read; its import may say more
    explicit operator bool() const { return driven || !bound.empty() || !skinned.empty(); }
};

// What is read by a child process, and so before threads are started: --skin, or a skinned model that INPUT is, where an output shows it.
// Notes go to o.common. Throws InputError for --skin.
ShownModel model_before_threads(TreesimOptions& o, const std::string& format);

// What is read once the trees are known: a SpeedTree file's mesh, of --skin, of INPUT, and each mesh that a file of a scene has. Refuses a model that
// gave a tree but has a mesh that cannot be read, and options that the mesh leaves nothing to decide.
// Throws UsageError, InputError.
void complete_model(ShownModel&, TreesimOptions& o, const Setting&, const std::string& format);

} // namespace bough
