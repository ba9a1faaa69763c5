// scan_radii.h: thin branches of a laser scan. A scanner's beam is a centimetre or two wide at a crown's distance, and wind moves twigs while it
// looks: what is thinner than some 5 cm is taken for thicker than it is.
//
// Pipe rule, over the length of wood that grows on beyond a place (leaves stand along twigs, and each needs its pipe): r^2.25 in proportion to it.
// From the trunk outward a place is seen as long as its radius is 25 mm and more. Beyond the last seen one, where the radius is R and the wood beyond
// is W,
//   r <= max(1.5 mm, R (w / W)^(1 / 2.25)),   w the wood beyond
// Nothing is made thicker, and what is seen stays as it is.
#pragma once
#include "import.h"

namespace bough {

constexpr double seen_radius = 0.025;   // [m]
constexpr double shoot_radius = 0.0015; // [m] of a year's shoot

// Reads and writes checked Splines in metres, radius alone. One note: how many radii, and the wood's volume before and after. O(points + branches log
// branches).
void bound_scan_radii(Splines&, ImportNotes&);

} // namespace bough
