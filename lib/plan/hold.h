// hold.h: decides which joints of a scene's trees are rigid (Simulate, scene.h), and writes Tree::rigid.
//
// A joint moves if all rules that /simulate gives let it, and the tree's own document does:
//   levels    those of the branch the body belongs to or grows on
//   radius    of the branch's body at its base; of what grows on one that body's
//   subtrees  the selected bodies and all they carry
//   box       holds the joint, drawn
//   error     Joints are held from the ends inward, by what each adds to the ends' motion (added_motion.h). The sum over the joints held on the way
//             from an end to the ground, which is how far holding is estimated to move that end, stays within `error`. With a view each joint's share
//             is taken in pixels, at its own distance from the viewer. Joints that the rules above hold are not counted.
// Reads a checked tree and scene. O(n), and the selectors. Throws std::out_of_range as select() does, and std::domain_error for an error without an
// estimate.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"
#include <string>
#include <vector>

namespace bough {

// How many joints move, and what holds the others. Each held joint counts once, for the first rule in this order that holds it.
struct HeldJoints {
    std::size_t joints = 0, moving = 0;
    std::size_t document = 0, level = 0, radius = 0, subtrees = 0, box = 0, error = 0;
};
std::string text_of(const HeldJoints&); // "120 of 1000 joints move; held: 700 by /simulate/last_level, ..."

HeldJoints hold_rigid(Tree&, const std::vector<TreeRange>&, const Scene&);

// Holds joints that move, from the ends inward. The motions [any unit, one a joint] of those held here, on the way from any end to the ground, add up
// to no more than `most`. Returns how many it holds. O(n).
std::size_t hold_small(Tree&, const std::vector<double>& motion, double most);

} // namespace bough
