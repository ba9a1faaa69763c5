// sway.h: how fast a tree as a whole sways, estimated without a simulation.
#pragma once
#include "tree.h"

namespace bough {

// First sway frequency [Hz] along a horizontal world direction (unit), by Rayleigh's quotient of the articulated tree:
// the shape u that the springs take under a steady sideways acceleration, omega^2 = u^T (K + K_g) u / u^T M u, with K_g
// the second-order change of height times weight (of rotations that do not commute, only the part that does: exact for
// sway in a plane). Above the true frequency by 0.4 % for a uniform cantilever, 3 % for a cone; never below the lowest
// mode of that direction. 0 where a joint has no stiffness or gravity [m/s^2, downward] would buckle the shape. Reads a
// checked Tree in the drawn pose. O(bodies).
double sway_frequency(const Tree&, const Vec3& direction, double gravity = 9.81);

} // namespace bough
