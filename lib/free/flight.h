// flight.h: free bodies in the air, up to where they meet something: where they would go in a step, and how fast they are at its end.
//
// Air. (21)-(23) act on each of a body's parts with the part's own velocity (air.h). Half of the growth with speed is implicit,
//   (m + h D) dv = h (m g + F),  (I + h D r^2) d omega = h tau,   D = sum kappa rho A 2 |u|, a bound on -dF/dv in any direction
// so that what is light reaches the wind's speed and does not pass it. A single leaf or petal flies by leaf_flight.h.
// A clump that has broken off is taken as a plate along its own y, whatever its leaf_facing; its leaves fold, but do not turn with the wind.
// Turning. The angular momentum L is kept except for the air's moment, and the body is turned under it by exact partial flows of the kinetic energy,
//   L^2/(2 I1) + L2^2/2 (1/I2 - 1/I1) + L3^2/2 (1/I3 - 1/I1),  I3 <= I2 <= I1
// about L, about the middle axis and about the long one (Dullweber, Leimkuhler, McLachlan, J. Chem. Phys. 107, 1997, with the symmetric part taken
// out). This is exact for a ball and any thin rod, however far they spin in a step. L is kept to rounding.
#pragma once
#include "../laws/wind.h"
#include "../model/scene.h"
#include "free_body.h"

namespace bough {

// Flies one step: finds the motion at its end if nothing is met. Without a wind the air stands still; with an air density of 0 there is no air.
FreeMotion fly(const FreeBody&, const Scene&, const WindTable<double>*, double h);

} // namespace bough
