// wood_overrides.h: what a scene changes of its trees' wood (Wood, scene.h; §9 of the paper: curves over radius, overrides of subtrees, global
// multipliers; §11: stiffer forks).
//
// The changes are made in this order, each on what the one before left. A body's joint is the one that carries it.
// factors  By the body's kind, K is multiplied by stiffness, beta by damping, mass and inertia by density (the centre of mass stays).
// curves   Curves act in the list's order on joints of branch bodies alone: of all trees, or of the subtrees of the bodies that `on` names, with
//          those bodies' own joints. The monotone cubic through the keys (monotone.h), at the radius of the body's base (Tree::size[1]), gives K, or
//          beta. Absolute: both bends get K, and twist keeps its ratio to their mean (where that is 0, twist keeps itself), whatever the factors and
//          earlier curves made of them. Relative: all three are multiplied by it. So later curves take precedence over earlier ones.
// fork     A fork is the place of a side branch on its bearer: the joint of a branch body whose parent is a body of another branch. d is the way
//          along the wood from a branch body's joint to the nearest fork:
//            outward  along its own body and on through those that continue it (continues_parent, tree.h), to where one bears a side branch
//            inward   through the bodies it continues, to a fork on them; a side branch's first joint is a fork: 0
//          It is measured along the bodies' axes (from joint to joint in z). K of all three axes is multiplied by
//            1 + (factor - 1) max(0, 1 - d / length)
//          which is factor at the fork, and 1 beyond length on either side. Leaves and fruit make no fork and are not stiffened. Where a tree is
//          segmented more finely, more joints lie within length: a stretch of wood is stiffened, not a number of joints.
// Reads   a joined, checked tree and a checked Wood. Writes stiffness, damping, mass, inertia. It runs before any plan is made of the tree; the
//         caller then resets the scene's wood, which make_plan refuses.
// Cost    O(bodies (1 + curves)). Throws std::out_of_range for a selector that names no body, with its place.
#pragma once
#include "scene.h"

namespace bough {

struct WoodChanges {
    std::size_t stiffness = 0, damping = 0; // joints that were changed
    std::size_t mass = 0;                   // bodies that were
    std::size_t forks = 0,
                near_forks = 0; // forks there are, joints within `length` of one; without /wood/fork not counted
};
WoodChanges override_wood(Tree& joined, const std::vector<TreeRange>&, const Wood&);

// Returns d [m] of every body's joint. It is infinite where there is no fork on the way, and for leaves, petals and fruit. O(bodies).
std::vector<double> way_to_fork(const Tree&);

} // namespace bough
