// parts.h: a scene whose trees are run by several programs, each a part of them.
//
// A park is cut by its trees: part i of n holds a run of trees that follow each other in the scene, chosen so that all parts have about as
// many bodies. What a part computes is what the whole scene does, bit by bit: trees do not act on each other unless something goes from one
// to another (balls, what breaks off, walkers, shelter), which is refused, and the wind is looked up in tables that are made for all trees (Part).
#pragma once
#include "../model/motion.h"
#include "assembly.h"
#include <functional>
#include <span>

namespace bough {

// Gives a scene's trees, asked for one after another, each once.
using TreeSource = std::function<Tree(const Placement&)>;
using OpenTrees = std::function<TreeSource(const Scene&)>;

// Stands the trees of the assembly's scene, as source gives them.
void stand_trees(Assembly&, const TreeSource&);
// The same of part `part` of `parts` (1 <= part <= parts): its own trees alone, and of the scene what concerns them. All trees of the scene are asked for
// once before, to measure them. Throws SceneError, which begins with what of the scene, or of a tree, parts cannot have.
void stand_part(Assembly&, std::int32_t part, std::int32_t parts, const OpenTrees&);

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
// What of a scene concerns those trees. Throws SceneError for what goes from tree to tree, and for what names bodies by place.
Scene scene_of_part(const Scene&, std::size_t first, std::size_t end);

// The hash of the whole run from what its parts, in their order, were at the same frame.
std::uint64_t hash_of_parts(std::span<const SavedState* const> parts);

} // namespace bough
