// parts.h: a scene whose trees are run by several programs, each a part of them.
//
// A park is cut between its trees. Part i of n holds a run of trees that follow each other in the scene, chosen so that all parts have about as many
// bodies. A part computes what the whole scene does, bit by bit. For trees do not act on each other unless something goes from one to another (balls,
// what breaks off, walkers, shelter), which is refused; the wind is looked up in tables that are made for all trees,
// and the laws are those that some tree of the whole asks for (Part).
#pragma once
#include "../model/motion.h"
#include "assembly.h"
#include <functional>
#include <span>

namespace bough {

// Gives a scene's trees. Each is asked for once, in order.
using TreeSource = std::function<Tree(const Placement&)>;
using OpenTrees = std::function<TreeSource(const Scene&)>;

// Stands the trees of the assembly's scene as the source gives them.
void stand_trees(Assembly&, const TreeSource&);
// Does the same for part `part` of `parts` (1 <= part <= parts): its own trees alone, and what concerns them of the scene. All trees of the scene are
// asked for once before, to measure them. Throws SceneError, which begins with what parts cannot have of the scene or of a tree.
void stand_part(Assembly&, std::int32_t part, std::int32_t parts, const OpenTrees&);

// Returns the first and the last + 1 of a part's units. `bodies` holds the bodies of each unit that may be cut apart. A part gets the units whose
// middle body is in its share of all bodies, moved on so that each part has at least one. There must be at least as many units as parts.
std::pair<std::size_t, std::size_t> units_of_part(const std::vector<std::size_t>& bodies, const Part&);
// A tree of a scene: its bodies, and which of them stand on the ground, rising.
struct TreeSize {
    std::size_t bodies;
    std::vector<std::size_t> roots;
};
// Returns the trees before which a scene may be cut (lib/lanes/stands.h), the first among them.
std::vector<std::size_t> cuts(const std::vector<TreeSize>&);
// Returns what of a scene concerns those trees. Throws SceneError for what goes from tree to tree, and for what names bodies by place.
Scene scene_of_part(const Scene&, std::size_t first, std::size_t end);

// Returns the whole run's hash from the parts' states, in order, at the same frame.
std::uint64_t hash_of_parts(std::span<const SavedState* const> parts);

} // namespace bough
