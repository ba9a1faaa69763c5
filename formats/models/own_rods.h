// own_rods.h: the bodies of wood that our own .glb says each joint holds, so that it can be read as the tree it shows and
// not as bones guessed from its mesh (private to this folder).
//
// Every joint of ours has extras: "bough_wood", runs of bodies of wood that it holds, in the order of bodies. A run has the branch, the branch of the
// body that carries its first body (-1: the ground), the number of points, two at least, and each point in the joint's own axes [m]: x y z and the
// wood's radius there. From one point to the next is a body. "bough_others" says how many leaves, petals and fruit the joint holds, where it holds
// some.
// They are relative to the joint: moved or scaled with the armature in another program, they still say where the wood is.
#pragma once
#include "formats/imports/imported_tree.h"
#include <array>
#include <nlohmann/json_fwd.hpp>

namespace bough {

// A body of wood: its branch, the branch of the body that carries it, its start and its end, each x y z and the radius there.
using OwnRod = std::array<double, 10>;

struct OwnRods {
    std::vector<std::vector<OwnRod>> rods; // of each node; empty as a whole: the file holds none, or not as above
    std::vector<char> ours;                // of each node: whether it is a joint that we wrote
    std::int64_t others = 0;               // leaves, petals and fruit
};

// Of a document's "nodes". O(nodes + rods).
OwnRods own_rods(const nlohmann::ordered_json& nodes);

// A rod of a joint that stands at `world`.
OwnRod in_world(const OwnRod&, const Eigen::Affine3d& world);

// Placed rods as branches, in the order of their numbers. Rods of a branch stand from base to tip, and behind a rod of
// the branch that carries them; a branch that none before carries is a root. O(rods log branches, and points of the
// parent for each branch).
std::vector<ImportedBranch> branches_of(const std::vector<OwnRod>&);

} // namespace bough
