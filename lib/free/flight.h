// flight.h: free bodies through the air, up to where they meet something: where they would go in a step, and how fast they are at its end.
//
// Air: (21)-(23) on each of a body's parts with its own velocity (air.h), half the speed's growth implicit,
//   (m + h D) dv = h (m g + F),  (I + h D r^2) d omega = h tau,   D = sum kappa rho A 2 |u|, a bound on -dF/dv in any direction
// so that what is light reaches the wind's speed and does not pass it. A single leaf or petal flies by leaf_flight.h.
// Turning: the angular momentum L is kept but for the air's moment, and the body turned under it by exact partial flows of the kinetic energy,
//   L^2/(2 I1) + L2^2/2 (1/I2 - 1/I1) + L3^2/2 (1/I3 - 1/I1),  I3 <= I2 <= I1
// : about L, about the middle axis, about the long one (Dullweber, Leimkuhler, McLachlan, J. Chem. Phys. 107, 1997, with the symmetric part
// taken out). Exact for a ball and any thin rod, whatever they spin by in a step; L is kept in bits but for rounding.
#pragma once
#include "../laws/wind.h"
#include "../model/scene.h"
#include "free_body.h"

namespace bough {

// A step's flight: the motion at its end if nothing is met. Without a wind the air stands still; in air of no density there is none.
FreeMotion fly(const FreeBody&, const Scene&, const WindTable<double>*, double h);

} // namespace bough
