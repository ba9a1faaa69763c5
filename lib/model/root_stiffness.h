// root_stiffness.h: ground that yields: a spring between the ground and each trunk.
//
// At the trunk's lowest joint (a body without parent) the ground's compliance and the wood's act in series:
//   1/K = 1/K_wood + 1/K_ground   about both bend axes; twist stays the wood's
// Damping. The trunk's joints keep the damping ratio that they have at the trunk's first bending frequency (branch_mode.h): beta is multiplied by
// omega before over omega after. So the ground damps as the wood does.
// Reads and writes stiffness and damping of the branch bodies that stand on the ground, and damping of those that continue them. stiffness: [N m/rad]
// above 0. A joint without stiffness stays without. O(bodies). Errors none.
#pragma once
#include "tree.h"

namespace bough {

// Returns how many joints were made softer.
std::size_t stand_on_springs(Tree&, double stiffness);

} // namespace bough
