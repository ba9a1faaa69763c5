// scene_trees.h: the trees of a scene, joined into one, all of them or those of a part (--shard).
//
// A park is cut by its trees: part i of n holds a run of trees that follow each other in the scene, chosen so that all parts have about as
// many bodies. What a part computes is what the whole scene does, bit by bit: trees do not act on each other unless something goes from one
// to another (balls, what breaks off, walkers, shelter), which is refused, and the wind is looked up in tables that are made for all trees (Part).
#pragma once
#include "lib/model/material_change.h"
#include "simulation.h"

namespace bough {

// Reads the trees of setting.scene, each file once, and stands them in setting.tree; of a part, its own alone, and of the scene what
// concerns them. Throws UsageError for a --shard that is none, InputError.
void stand_trees(Setting&, const std::string& scene_file, const std::string& shard, const MaterialChange&);
// "i/n", 1 <= i <= n. Throws UsageError.
Part parse_shard(const std::string&);
// What is cut apart: bodies of each unit. First and last + 1 of a part's units: those whose middle body is in the part's share of all bodies, moved on so that each part
// has at least one. As many units as parts, or more.
std::pair<std::size_t, std::size_t> units_of_part(const std::vector<std::size_t>& bodies, const Part&);
// A tree of a scene: its bodies, and which of them stand on the ground, rising.
struct TreeSize {
    std::size_t bodies;
    std::vector<std::size_t> roots;
};
// Trees before which a scene may be cut (lib/lanes/stands.h), the first among them.
std::vector<std::size_t> cuts(const std::vector<TreeSize>&);
// What of a scene concerns those trees. Throws UsageError for what goes from tree to tree, and for what names bodies by place.
Scene scene_of_part(const Scene&, std::size_t first, std::size_t end);

} // namespace bough
