// bark.h: leaves, flowers and fruit stay on a branch's surface when its radius grows.
#pragma once
#include "../model/splines.h"
#include <vector>

namespace bough {

// Moves leaves and fruit outward, away from their branch's axis, by what the radius there has grown from `drawn` (an entry
// a point). Both move with their joint, keeping direction and size. Cost O(items + points) where items stand branch by branch. Errors none.
void seat_on_bark(Splines&, const std::vector<double>& drawn);

// Radius [m] at fraction `at` of branch's arc length, linear between its points. O(points of the branch).
double radius_at(const Splines&, std::int32_t branch, double at);

} // namespace bough
