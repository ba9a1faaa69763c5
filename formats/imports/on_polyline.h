// on_polyline.h: places on polylines.
#pragma once
#include "lib/base/math.h"

namespace bough {

// The point of a polyline nearest to p. O(points).
struct OnPolyline {
    std::size_t segment = 0; // between points segment and segment + 1
    double t = 0;            // fraction of that segment
    double distance = 0;     // from p
    double fraction = 0;     // of the polyline's arc length
};
OnPolyline nearest_on(const std::vector<Vec3>& polyline, const Vec3& p);

// Fraction of the way from a to b where p projects to, within 0..1.
double projected(const Vec3& a, const Vec3& b, const Vec3& p);

} // namespace bough
