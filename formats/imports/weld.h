// weld.h: points at one place made one.
#pragma once
#include "lib/base/math.h"
#include <vector>

namespace bough {

// Tolerance [file unit] for points given as text or floats: 1e-6 of their extent, or, where they lie far from the
// origin, the spacing of floats there.
double weld_tolerance(const std::vector<Vec3>&);

// Index of each point among the points that are left, which keep their order and are moved to the front of `point`.
// A point joins the first one before it that lies within the tolerance. Near O(points), by a hash of cells.
std::vector<std::int32_t> weld(std::vector<Vec3>& point, double tolerance);

} // namespace bough
