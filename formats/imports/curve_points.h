// curve_points.h: points along the curves that model files hold, so that a curve becomes a polyline.
#pragma once
#include "lib/base/math.h"
#include <optional>
#include <vector>

namespace bough {

constexpr int curve_steps = 4; // points a span between knots

// A B-spline of this degree over `knot`, which has one entry more than points + degree and never falls. Nothing where
// the curve does not reach its first and last point (knots not clamped there), where there are fewer points than
// degree + 1 or the knots do not fit: then the points themselves are the better line. `weight`: one a point, or empty.
std::optional<std::vector<Vec3>> bspline_points(const std::vector<Vec3>& point, const std::vector<double>& weight,
                                                const std::vector<double>& knot, int degree);

// Bezier pieces of this degree one after another: points 0..degree, degree..2 degree, ... Nothing where the count does
// not fit.
std::optional<std::vector<Vec3>> bezier_points(const std::vector<Vec3>& point, const std::vector<double>& weight,
                                               int degree);

// A point of the cubic Bezier with these corners, t in 0..1.
inline Vec3 cubic_bezier(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, double t) {
    const double s = 1 - t;
    return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
}

} // namespace bough
