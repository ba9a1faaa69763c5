// root_stiffness.h: ground that gives way: a spring between the ground and each trunk.
//
// Its compliance and that of the wood lie one behind the other at the trunk's lowest joint (a body without parent):
//   1/K = 1/K_wood + 1/K_ground   about both bend axes; twist stays the wood's
// Damping. The trunk's joints keep the ratio that they have at its first bending frequency (branch_mode.h): beta times omega before over omega after.
// So the ground damps as the wood does.
// Reads and writes stiffness and damping of the branch bodies that stand on the ground, and damping of those that go on them. stiffness: [N m/rad] above 0.
// A joint that has no stiffness keeps none. O(bodies). Errors none.
#pragma once
#include "tree.h"

namespace bough {

// Returns how many joints were made softer.
std::size_t stand_on_springs(Tree&, double stiffness);

} // namespace bough
