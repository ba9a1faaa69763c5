// shown_model.h: the model that treesim shows in place of a mesh made from the tree: the one --skin names, or INPUT's own.
#pragma once
#include "formats/models/speedtree_model.h"
#include "formats/models/user_model.h"
#include "treesim_options.h"

namespace bough {

struct ShownModel {                      // at most one of them
    std::optional<UserModel> driven;     // moved by its bones (driven_model.h): a .glb alone
    std::optional<SpeedtreeModel> bound; // bound to the tree's bodies (speedtree_model.h): any mesh
    std::string failed;                  // why INPUT's own model cannot be read; its import may say more
    explicit operator bool() const { return driven || bound; }
};

// Whether a file is SpeedTree XML, by its head; false for stdin.
bool is_speedtree_file(const std::string& path);

// What is read by a child process, and so before threads are started: --skin, or a skinned model that INPUT is, where a .glb is written.
// Notes go to o.common. Throws InputError for --skin.
ShownModel model_before_threads(TreesimOptions& o, const std::string& format);

// What is read once the tree is known: a SpeedTree file's mesh, of --skin or INPUT. Refuses a model that gave a tree but has a mesh that cannot be
// read, and options that the mesh leaves nothing to decide.
// Throws UsageError, InputError.
void complete_model(ShownModel&, TreesimOptions& o, const Setting&, const std::string& format);

} // namespace bough
