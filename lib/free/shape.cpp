#include "shape.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

// Parameters in 0..1 of the nearest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
std::pair<double, double> nearest_parameters(const Capsule& p, const Capsule& q) {
    const Vec3 d1 = p.b - p.a, d2 = q.b - q.a, r = p.a - q.a;
    const double a = d1.squaredNorm(), e = d2.squaredNorm(), f = d2.dot(r);
    const auto unit = [](double x) { return std::clamp(x, 0.0, 1.0); };
    if (a <= 0 && e <= 0) return {0, 0};
    if (a <= 0) return {0, unit(f / e)};
    const double c = d1.dot(r);
    if (e <= 0) return {unit(-c / a), 0};
    const double b = d1.dot(d2), denominator = a * e - b * b;
    double s = denominator > 1e-12 * a * e ? unit((b * f - c * e) / denominator) : 0.5; // parallel: any
    double t = (b * s + f) / e;
    if (t < 0 || t > 1) {
        t = unit(t);
        s = unit((b * t - c) / a);
    }
    return {s, t};
}

constexpr double touching = 1e-6; // [m] gap that counts as none

// The part of their ways for which two capsules stay on their sides of a plane across `normal`: no end of the one comes nearer to an end of the other
// along it than half of what counts as touching. 0 where they are not parted by one.
double apart_for(const Capsule& first, const Capsule& first_end, const Capsule& second, const Capsule& second_end,
                 const Vec3& normal) {
    double part = 1;
    const auto end = [&](const Vec3& p, const Vec3& p_end, double p_radius, const Vec3& q, const Vec3& q_end,
                         double q_radius) {
        const double radii = p_radius + q_radius + 0.5 * touching;
        const double gap = normal.dot(p - q) - radii, later = normal.dot(p_end - q_end) - radii;
        if (gap <= 0)
            part = 0;
        else if (later < 0)
            part = std::min(part, gap / (gap - later));
    };
    end(first.a, first_end.a, first.radius_a, second.a, second_end.a, second.radius_a);
    end(first.a, first_end.a, first.radius_a, second.b, second_end.b, second.radius_b);
    end(first.b, first_end.b, first.radius_b, second.a, second_end.a, second.radius_a);
    end(first.b, first_end.b, first.radius_b, second.b, second_end.b, second.radius_b);
    return part;
}

} // namespace

Capsule capsule_of(Kind kind, const Vec3& size) {
    switch (kind) {
    case Kind::leaf:
    case Kind::petal:
    case Kind::clump:
    case Kind::tuft:
        return {Vec3::Zero(), Vec3(0, 0, size[0]), size[1] / 4, size[1] / 4};
    case Kind::fruit:
        return {Vec3(0, 0, size[0]), Vec3(0, 0, size[0]), size[1], size[1]};
    case Kind::branch:
        break;
    }
    return {Vec3::Zero(), Vec3(0, 0, size[0]), size[1], size[2]};
}

Capsule placed(const Capsule& c, const Quat& q, const Vec3& x) {
    return {x + q * c.a, x + q * c.b, c.radius_a, c.radius_b};
}

Bound bound_of(const Capsule& c) {
    return {0.5 * (c.a + c.b), 0.5 * Vec3(c.b - c.a).norm() + std::max(c.radius_a, c.radius_b)};
}

Nearest nearest(const Capsule& first, const Capsule& second) {
    const auto [s, t] = nearest_parameters(first, second);
    const Vec3 p = first.a + s * (first.b - first.a), q = second.a + t * (second.b - second.a);
    const double r1 = first.radius_a + s * (first.radius_b - first.radius_a);
    const double r2 = second.radius_a + t * (second.radius_b - second.radius_a);
    const Vec3 way = p - q;
    const double distance = way.norm();
    Vec3 normal = way / distance;
    if (!(distance >
          1e-12)) { // axes that cross have no line between them: across both then, or across the second's, upward
        normal = (first.b - first.a).cross(Vec3(second.b - second.a));
        const Vec3 along = Vec3(second.b - second.a).normalized();
        for (const Vec3& up : {Vec3(Vec3::UnitY()), Vec3(Vec3::UnitX())})
            if (!(normal.norm() > 1e-12)) normal = up - along.dot(up) * along;
        normal.normalize();
    }
    return {distance - r1 - r2, normal, q + r2 * normal};
}

Meeting meet(const Capsule& first, const Capsule& first_end, const Capsule& second, const Capsule& second_end) {
    const auto between = [](const Capsule& from, const Capsule& to, double way) {
        return Capsule{from.a + way * (to.a - from.a), from.b + way * (to.b - from.b), from.radius_a, from.radius_b};
    };
    double fastest = 0;
    for (const Vec3& p : {Vec3(first_end.a - first.a), Vec3(first_end.b - first.b)})
        for (const Vec3& q : {Vec3(second_end.a - second.a), Vec3(second_end.b - second.b)})
            fastest = std::max(fastest, Vec3(p - q).norm());
    Meeting meeting;
    const Bound one = bound_of(first), other = bound_of(second); // most pairs never come near
    if (Vec3(one.middle - other.middle).norm() > one.radius + other.radius + fastest) return meeting;
    for (double way = 0;;) {
        const Capsule one_now = between(first, first_end, way), other_now = between(second, second_end, way);
        meeting.at = nearest(one_now, other_now);
        if (meeting.at.gap <= touching) {
            meeting.way = way;
            meeting.meets = true;
            return meeting;
        }
        // What is left of the way does not close the gap.
        if (way >= 1 || (1 - way) * fastest < meeting.at.gap) return meeting;
        const double by_speed = meeting.at.gap / fastest;
        const double by_plane = (1 - way) * apart_for(one_now, first_end, other_now, second_end, meeting.at.normal);
        if (by_plane >= 1 - way) return meeting;
        way = std::min(1.0, way + std::max(by_speed, by_plane));
    }
}

} // namespace bough
