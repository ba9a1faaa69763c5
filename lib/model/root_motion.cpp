#include "root_motion.h"
#include "../base/nearest_vector.h"
#include "../base/rotation_maps.h"
#include <algorithm>

namespace bough {

RootSpline make_root_spline(const RootMotion& motion, const Vec3& pivot) {
    RootSpline spline;
    spline.pivot = pivot;
    if (!motion.position.empty()) spline.position = make_quintic(motion.time, motion.position);
    if (motion.rotation.empty()) return spline;
    const Quat first = motion.rotation.front().normalized();
    spline.first = first.toRotationMatrix();
    std::vector<Vec3> phi;
    for (const Quat& q : motion.rotation)
        phi.push_back(
            nearest_vector(q.normalized() * first.conjugate(), phi.empty() ? Vec3(Vec3::Zero()) : phi.back()));
    spline.rotation = make_quintic(motion.time, phi);
    return spline;
}

Ground ground_at(const RootSpline& spline, double t) {
    Ground ground;
    if (spline.rotation) {
        const CurvePoint phi = curve_at(*spline.rotation, t);
        const RotationMaps<double> maps = rotation_maps<double>(phi.x);
        ground.R = maps.R * spline.first;
        ground.omega = maps.J * phi.v;
        ground.alpha = maps.J * phi.a + maps.rate_bias(phi.v);
    }
    const Vec3 arm = ground.R * spline.pivot; // from the world's origin as it is carried to the pivot
    const CurvePoint p = spline.position ? curve_at(*spline.position, t) : CurvePoint{};
    ground.x = p.x + (spline.pivot - arm);
    ground.v = p.v - ground.omega.cross(arm);
    ground.a = p.a - ground.alpha.cross(arm) - ground.omega.cross(ground.omega.cross(arm));
    return ground;
}

double highest(const RootSpline& spline, const Vec3& X) {
    const double lift = spline.position ? greatest(*spline.position, 1) : 0;
    return lift + (spline.rotation ? spline.pivot.y() + (X - spline.pivot).norm() : X.y());
}

double farthest(const RootSpline& spline, const Vec3& X, double x, double z) {
    double moved = 0;
    if (spline.position) {
        QuinticSpline back = *spline.position;
        for (auto* keys : {&back.x, &back.v, &back.a})
            for (Vec3& key : *keys) key = -key;
        const auto most = [&](int axis) { return std::max(greatest(*spline.position, axis), greatest(back, axis)); };
        moved = std::hypot(most(0), most(2));
    }
    const Vec3& stands = spline.rotation ? spline.pivot : X;
    return moved + std::hypot(stands.x() - x, stands.z() - z) + (spline.rotation ? (X - spline.pivot).norm() : 0);
}

std::int64_t spline_under(const std::vector<MovedTree>& moved, std::size_t body) {
    const auto after = std::upper_bound(moved.begin(), moved.end(), body,
                                        [](std::size_t b, const MovedTree& tree) { return b < tree.first_body; });
    if (after == moved.begin()) return -1;
    const MovedTree& tree = *(after - 1);
    return body - tree.first_body < tree.bodies ? std::int64_t(tree.spline) : -1;
}

} // namespace bough
