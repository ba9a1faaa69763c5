// float_range.h: whether positions keep their shape in floats.
#pragma once
#include "lib/base/math.h"
#include <algorithm>
#include <limits>
#include <vector>

namespace bough {

// Floats keep 7 digits of a coordinate. False where that is coarser than 1e-6 of the points' own extent: far from the
// origin (laser scans). O(points).
inline bool floats_suffice(const std::vector<Vec3>& position) {
    if (position.empty()) return true;
    Vec3 low = position[0], high = position[0];
    for (const Vec3& p : position) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    return farthest * std::numeric_limits<float>::epsilon() <= 1e-6 * (high - low).maxCoeff();
}

} // namespace bough
