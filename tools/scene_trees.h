// scene_trees.h: the trees of a scene from their files, joined into one, all of them or those of a part (--shard).
#pragma once
#include "lib/model/material_change.h"
#include "lib/simulation/parts.h"
#include <algorithm>

namespace bough {

// What a tree's file says of how it looks.
struct TreeLook {
    std::string name;
    std::vector<Vec3> color; // Tree::color
    bool operator<(const TreeLook& other) const {
        const auto below = [](const Vec3& a, const Vec3& b) {
            return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
        };
        if (name != other.name) return name < other.name;
        return std::lexicographical_compare(color.begin(), color.end(), other.color.begin(), other.color.end(), below);
    }
};

struct TreesRead {
    std::vector<std::string> notes{};     // on trees that were converted (converted.h)
    std::vector<std::string> converted{}; // those
    std::vector<TreeLook> looks{};        // of each of the scene's trees
};
// Reads the trees of the assembly's scene, each file once, and stands them in it; of a part ("i/n"; empty: all) its own alone, and of the scene what
// concerns them. Throws UsageError for a shard that is none, InputError.
TreesRead read_trees(Assembly&, const std::string& scene_file, const std::string& shard, const MaterialChange&);

} // namespace bough
