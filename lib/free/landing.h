// landing.h: a leaf or petal that comes to the ground.
//
// A card's last flutter above the ground is below what a step of 1/30 s resolves: from the first touch on it slides no more and its plane turns to
// the ground's, by e^(-t / 0.08 s) of the angle that is left; within half a degree it lies, and is at rest.
#pragma once
#include "free_body.h"

namespace bough {

// One step [s] of it; true at the first touch.
bool lie_down(FreeBody& leaf, double ground_height, double h);

} // namespace bough
