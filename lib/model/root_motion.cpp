#include "root_motion.h"
#include "../base/nearest_vector.h"
#include <algorithm>

namespace bough {
namespace {

// The rate of body_rate_jacobian(theta) where theta changes at theta_dot: with J = 1 - f theta* + s theta* theta*,
// f' = (theta.theta_dot) (sin a / a - 2 f) / a^2 and s' = (theta.theta_dot) (f - 3 s) / a^2. Series below 0.1 rad.
Mat3 body_rate_jacobian_rate(const Vec3& theta, const Vec3& theta_dot) {
    const double a2 = theta.squaredNorm(), a = std::sqrt(a2), h = std::sin(a / 2);
    const bool small = a < 0.1;
    const double f = small ? 0.5 - a2 / 24 * (1 - a2 / 30 * (1 - a2 / 56)) : 2 * h * h / a2;
    const double s = small ? 1.0 / 6 - a2 / 120 * (1 - a2 / 42 * (1 - a2 / 72)) : (a - std::sin(a)) / (a2 * a);
    const double df = small ? -1.0 / 12 + a2 / 180 * (1 - 3 * a2 / 112) : (std::sin(a) / a - 2 * f) / a2;
    const double ds = small ? -1.0 / 60 + a2 / 1260 * (1 - a2 / 48) : (f - 3 * s) / a2;
    const double along = theta.dot(theta_dot);
    const Mat3 x = cross_matrix(theta), y = cross_matrix(theta_dot);
    return along * (ds * (x * x) - df * x) - f * y + s * (x * y + y * x);
}

} // namespace

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
        const Vec3 back = -phi.x, back_rate = -phi.v;
        const Mat3 J = body_rate_jacobian(back);
        ground.R = rotation_from_vector(phi.x) * spline.first;
        ground.omega = J * phi.v;
        ground.alpha = J * phi.a + body_rate_jacobian_rate(back, back_rate) * phi.v;
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
