// polyline.h: a curve as points with straight lines between them.
#pragma once
#include "splines.h"
#include <span>

namespace bough {

// Returns how far along the curve each point stands from the first [unit of the points]. O(points).
inline std::vector<double> arc_lengths(std::span<const Vec3> point) {
    std::vector<double> arc(point.size(), 0);
    for (std::size_t k = 1; k < point.size(); ++k) arc[k] = arc[k - 1] + (point[k] - point[k - 1]).norm();
    return arc;
}

// Returns the points of one branch, base to tip.
inline std::span<const Vec3> points_of(const Splines& s, std::size_t branch) {
    const auto first = std::size_t(s.first_point[branch]);
    return std::span(s.point).subspan(first, std::size_t(s.first_point[branch + 1]) - first);
}

} // namespace bough
