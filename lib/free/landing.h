// landing.h: a leaf or petal that comes to the ground.
//
// A card's last flutter above the ground is too fast for a step of 1/30 s to resolve. So from the first touch on it slides no more, and its plane
// turns to the ground's: the angle that is left falls by e^(-t / 0.08 s). Within half a degree it lies, and is at rest.
#pragma once
#include "free_body.h"

namespace bough {

// Takes one step [s] of it. Returns true at the first touch.
bool lie_down(FreeBody& leaf, double ground_height, double h);

} // namespace bough
