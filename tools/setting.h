// setting.h: what a run is of: its trees joined into one, and the scene with the options applied.
#pragma once
#include "file_names.h"
#include "lib/stages/reduce.h"
#include "run_options.h"
#include <memory>

namespace bough {

// Which part of a scene's trees a run has (scene_trees.h), and what it must know of the whole.
struct Part {
    std::int32_t part = 1, parts = 1;
    std::int64_t first_body = 0;  // in the whole scene's order
    double top = 0, reach = 0;    // Wishes
    std::vector<double> clocks{}; // likewise
    std::uint64_t whole = 0;      // of all trees and the whole scene, as fingerprint()
    bool moved =
        false; // the ground of some tree moves, of this part or another: then what a still ground allows is left out
};

// What a run of a part of it is of (rigid_parts.h).
struct Whole {
    Tree tree; // all bodies, none held
    Scene scene;
    Reduced places; // where each body is on the tree that runs, which is not in here
};

// The trees of a run joined into one, and the scene with the options applied.
struct Setting {
    Tree tree;
    std::vector<TreeRange> ranges;
    Scene scene;
    std::string source; // command lines of the inputs
    Part part = {};
    std::vector<std::string>
        changes{}; // what of the scene is in the tree by now, and no longer in the scene: a line each, for --explain
    std::uint64_t fingerprint =
        0; // fingerprint(), where a state is saved or resumed: of the tree before it is handed over
    std::vector<std::string> tree_files{}; // of a scene: where its trees are read from, each once, of other parts too
    std::shared_ptr<const Whole> whole{};  // where joints are held; tree, ranges and scene are then of what moves
};
// Reads a tree, or a scene and its trees; /wood and /load are put into the tree, rigid parts joined (rigid_parts.h). Throws UsageError,
// InputError.
Setting read_setting(const RunOptions&);

// The files that read_setting reads: INPUT, the trees of a scene, each once, the wind's. Throws as it does where the scene cannot be read.
std::vector<std::string> files_read(const RunOptions&);

// Throws UsageError where an output is a file that a tree of the scene was read from. What the options name is compared before anything
// is read (refuse_overwriting).
void refuse_overwriting_trees(const Setting&, const std::vector<NamedFile>& written);

// What the options make of an empty scene, without trees. Throws UsageError, InputError.
Scene chosen_scene(const RunOptions&);

// 64 bits of all that decides how a run goes on: the joined tree's numbers and the scene's.
std::uint64_t fingerprint(const Setting&);

} // namespace bough
