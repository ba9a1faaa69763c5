// scene_trees.h: the trees of a scene from their files, joined into one, all of them or those of a part (--shard).
#pragma once
#include "lib/model/material_change.h"
#include "lib/simulation/parts.h"

namespace bough {

struct TreesRead {
    std::vector<std::string> notes{};     // on trees that were converted (converted.h)
    std::vector<std::string> converted{}; // those
};
// Reads the trees of the assembly's scene, each file once, and stands them in it; of a part ("i/n"; empty: all) its own alone, and of the scene what
// concerns them. Throws UsageError for a shard that is none, InputError.
TreesRead read_trees(Assembly&, const std::string& scene_file, const std::string& shard, const MaterialChange&);

} // namespace bough
