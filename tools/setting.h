// setting.h: what a run is of: its trees joined into one, and the scene with the options applied.
#pragma once
#include "file_names.h"
#include "formats/imports/import.h"
#include "lib/simulation/assembly.h"
#include "run_options.h"
#include "scene_trees.h"

namespace bough {

// What a run is of, and where it came from.
struct Setting : Assembly {
    std::vector<std::string> tree_files{}; // of a scene: where its trees are read from, each once, of other parts too
    std::vector<std::string> notes{};      // on trees that were converted (converted.h)
    std::vector<std::string> converted{};  // those: files, INPUT among them
    std::vector<TreeLook> looks{};         // of a scene: of each of its trees
    std::optional<ImportNotes> imported{}; // what was found of INPUT, where it was converted
};
// Reads a tree of any kind (converted.h), or a scene and its trees; /wood and /load are put into the tree, rigid parts joined (assembly.h). Throws
// UsageError, InputError.
Setting read_setting(const RunOptions&);

// change_wood and join_rigid, whose errors become the input's.
void apply_scene(Setting&, const std::string& input);

// The files that read_setting reads: INPUT, the trees of a scene, each once, the wind's. Throws as it does where the scene cannot be read.
std::vector<std::string> files_read(const RunOptions&);

// Throws UsageError where an output is a file that a tree of the scene was read from, or that a model names. What the options name is compared before
// anything is read (refuse_overwriting).
void refuse_overwriting_trees(const Setting&, const std::vector<NamedFile>& written);

// What the options make of an empty scene, without trees. Throws UsageError, InputError.
Scene chosen_scene(const RunOptions&);

} // namespace bough
