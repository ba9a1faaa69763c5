// wood_overrides.h: what a scene changes of its trees' wood (Wood, scene.h; §9 of the paper: curves over radius, overrides of subtrees, global
// multipliers; §11: stiffer forks).
//
// In this order, each on what the one before left; a joint is that of the body it carries:
// factors  By the body's kind: K times stiffness, beta times damping, mass and inertia times density (the centre of mass stays).
// curves   In the list's order; joints of branch bodies alone, of all trees or of the subtrees of the bodies that `on` names, those
//          bodies' own joints with them. At the body's radius at its base (Tree::size[1]) the monotone cubic through the keys
//          (monotone.h) gives K, or beta. Absolute: both bends get K, twist keeps its ratio to their mean (where that is 0, itself),
//          whatever the factors and earlier curves made of them; relative: all three are multiplied by it. So later curves come before earlier ones.
// fork     A fork is the place of a side branch on its bearer: the joint of a branch body whose parent is a body of another branch. d: the way
//          along the wood from a branch body's joint to the nearest fork,
//            outward  along its own body and on through those that continue it (continues_parent, tree.h), to where one bears a side branch
//            inward   through the bodies it continues, to a fork on them; a side branch's first joint is one: 0
//          measured along the bodies' axes (from joint to joint in z). K of all three axes is multiplied by
//            1 + (factor - 1) max(0, 1 - d / length)
//          so at the fork by factor, beyond length on either side by 1. Leaves and fruit make no fork and are not stiffened.
//          Where a tree is segmented more finely, more joints lie within length: what is stiff is a stretch of wood, not a number of joints.
// Reads   a joined, checked tree and a checked Wood. Writes stiffness, damping, mass, inertia. Before any plan is made of the tree: the
//         scene's wood is then to be reset (make_plan refuses it).
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

// d [m] of every body's joint, infinite where there is no fork on the way, and of leaves, petals and fruit. O(bodies).
std::vector<double> way_to_fork(const Tree&);

} // namespace bough
