// shelter.h: what bodies that stand upwind leave of the wind: trees behind trees, and leaves within their own crown.
//
// Model. The air goes straight through the scene along the mean wind's direction e (Wind::velocity), in columns of side `cell` whose
// section is A = cell^2. Of each column's flux of momentum, rho u^2 A, a body takes its drag: from body to body along the way
//   rho A d(u^2) = -F_b,   F_b = kappa rho A_b u_b^2 (f_b . e),   f_b the law of air.h over u_b^2 for a wind of u_b along e on the standing body
// With u_b the column's speed before the body, u after it is u_b sqrt(1 - kappa A_b (f_b . e) / A): what is taken from the columns is the sum of
// the bodies' drags exactly, the first body of a column has all of the wind, and a crown of many leaves thins it out exponentially, with
// no constant of its own. What stands for many bodies, a clump or wood that others are one with (Tree::drag), thins the air out within
// itself as they would one after another: with s its share kappa A_b (f_b . e) / A, u falls from u_0 to u_0 exp(-s / 2), and it feels u_b,
// at which its drag is what the column loses:
// u_b^2 s = u_0^2 (1 - exp(-s)). So does a leaf whose share, as it unfolds where there is less wind, would be more than half of what is left.
// A body counts in the column of its centre of mass, in the pose at the start; what is beside the columns does not mix in. The factor u_b
// over the undisturbed u multiplies all of the wind at the body, over all of the run.
#pragma once
#include "plan.h"

namespace bough {

// Of each body [1]. Reads the plan's constants of bodies, theta_start and drag_area; Tree::drag. O(n log n).
// Throws std::domain_error for a body that alone takes more than what a column has: the cell is too small.
template <class T> std::vector<T> shelter_factors(const Plan<T>&, const std::vector<double>& tree_drag);

} // namespace bough
