// plan_reach.h: how far up and out over the ground bodies could ever be, stretched as far as they can be, on any way that their roots are moved. The
// wind's tables cover this. O(n). Reads a checked tree, and the plan's root splines with what they move (root_motion.h).
#pragma once
#include "../model/tree.h"
#include "plan.h"

namespace bough {

// [m] Returns the highest point that a body could reach by standing straight up from the ground: for the wind's profile.
double highest_reach(const Tree&, const std::vector<RootSpline>&, const std::vector<MovedTree>&);
// [m] Returns the farthest point over the ground from (x, z) that a body could reach in the same way: for the swirl.
double farthest_reach(const Tree&, const std::vector<RootSpline>&, const std::vector<MovedTree>&, double x, double z);

} // namespace bough
