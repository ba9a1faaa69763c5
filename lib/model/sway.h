// sway.h: how fast a tree as a whole sways, estimated without a simulation.
#pragma once
#include "tree.h"

namespace bough {

// First sway frequency [Hz] along a horizontal world direction (unit), by Rayleigh's quotient of the articulated tree:
// the shape u that the springs take under a steady sideways acceleration, omega^2 = u^T K u / u^T M u. Above the true
// one by 0.4 % for a uniform cantilever, 3 % for a cone; never below the lowest mode of that direction. Gravity's own stiffness is
// not counted (a few per cent in slender trees). Reads a checked Tree in the drawn pose with stiffness above 0; a joint
// without stiffness gives 0. O(bodies).
double sway_frequency(const Tree&, const Vec3& direction);

} // namespace bough
