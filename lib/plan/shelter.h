// shelter.h: what bodies that stand upwind leave of the wind, for trees behind trees and for leaves within their own crown.
//
// Model. The air goes straight through the scene along the mean wind's direction e (Wind::velocity), in columns of side `cell`, whose section is A =
// cell^2. A body takes its drag from its column's flux of momentum, rho u^2 A. From body to body along the way
//   rho A d(u^2) = -F_b,   F_b = kappa rho A_b u_b^2 (f_b . e),   f_b the law of air.h over u_b^2 for a wind of u_b along e on the standing body
// With u_b the column's speed before the body, the speed after it is u_b sqrt(1 - kappa A_b (f_b . e) / A). So the columns lose exactly the sum of
// the bodies' drags, the first body of a column has all of the wind, and a crown of many leaves thins the wind out exponentially, without a constant
// of its own. Some bodies stand for many: a clump, or wood that others are one with (Tree::drag). Such a body thins the air out within itself as the
// many would one after another. With s its share kappa A_b (f_b . e) / A, u falls from u_0 to u_0 exp(-s / 2). The body feels the u_b at which its
// drag is what the column loses: u_b^2 s = u_0^2 (1 - exp(-s)). The same holds for a leaf whose share would be more than half of what is left, since
// it unfolds where there is less wind.
// A body counts in the column of its centre of mass, in the pose at the start. The air beside the columns does not mix in. The factor u_b over the
// undisturbed u multiplies all of the wind at the body, over all of the run.
#pragma once
#include "plan.h"

namespace bough {

// Returns the factor [1] of each body. Reads the plan's constants of bodies, theta_start and drag_area, and Tree::drag. O(n log n). Throws
// std::domain_error for a body that alone takes more than a column has: the cell is then too small.
template <class T> std::vector<T> shelter_factors(const Plan<T>&, const std::vector<double>& tree_drag);

} // namespace bough
