#include "on_polyline.h"
#include <algorithm>
#include <limits>

namespace bough {

double projected(const Vec3& a, const Vec3& b, const Vec3& p) {
    const Vec3 d = b - a;
    const double d2 = d.squaredNorm();
    return d2 > 0 ? std::clamp((p - a).dot(d) / d2, 0.0, 1.0) : 0.0;
}

OnPolyline nearest_on(const std::vector<Vec3>& polyline, const Vec3& p) {
    OnPolyline best;
    best.distance = std::numeric_limits<double>::infinity();
    double arc = 0, arc_best = 0;
    for (std::size_t k = 0; k + 1 < polyline.size(); ++k) {
        const Vec3& a = polyline[k];
        const Vec3& b = polyline[k + 1];
        const double t = projected(a, b, p);
        const double length = (b - a).norm();
        const double distance = (a + t * (b - a) - p).norm();
        if (distance < best.distance) {
            best.segment = k;
            best.t = t;
            best.distance = distance;
            arc_best = arc + t * length;
        }
        arc += length;
    }
    best.fraction = arc > 0 ? std::min(1.0, arc_best / arc) : 0.0;
    return best;
}

} // namespace bough
