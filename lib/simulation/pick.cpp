#include "pick.h"
#include "../model/body_shape.h"
#include <array>
#include <limits>
#include <numbers>

namespace bough {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

// The ray in a body's frame: o + t d, |d| = 1, t >= 0.
struct Local {
    Vec3 o, d;
    Vec3 at(double t) const { return o + t * d; }
};

// Both roots of a t^2 + 2 b t + c, without cancellation; none where there are none.
std::array<double, 2> roots(double a, double b, double c) {
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0)) return {none, none};
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    return {a != 0 ? q / a : none, q != 0 ? c / q : none};
}

// Side: x^2 + y^2 = (base + k z)^2 between z = 0 and the length; ends: discs.
double meet_frustum(const Local& ray, double length, double base, double tip) {
    double first = none;
    const double k = (tip - base) / length, r = base + k * ray.o.z();
    const auto side = roots(ray.d.x() * ray.d.x() + ray.d.y() * ray.d.y() - k * k * ray.d.z() * ray.d.z(),
                            ray.o.x() * ray.d.x() + ray.o.y() * ray.d.y() - k * ray.d.z() * r,
                            ray.o.x() * ray.o.x() + ray.o.y() * ray.o.y() - r * r);
    for (const double t : side)
        if (const double z = ray.at(t).z(); t >= 0 && z >= 0 && z <= length) first = std::min(first, t);
    for (const auto& [z, radius] : {std::pair(0.0, base), std::pair(length, tip)}) {
        const double t = (z - ray.o.z()) / ray.d.z(); // level: no number, or none that is finite
        if (t >= 0 && ray.at(t).head<2>().squaredNorm() <= radius * radius) first = std::min(first, t);
    }
    return first;
}

// |(p - center) / half axes| = 1.
double meet_ellipsoid(const Local& ray, const Vec3& center, const Vec3& half) {
    const Vec3 o = (ray.o - center).cwiseQuotient(half), d = ray.d.cwiseQuotient(half);
    double first = none;
    for (const double t : roots(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1))
        if (t >= 0) first = std::min(first, t);
    return first;
}

// Corners (0, 0), (+-width / 2, widest length), (0, length) in x and z.
double meet_kite(const Local& ray, double length, double width, double widest) {
    const double t = -ray.o.y() / ray.d.y();
    if (!(t >= 0) || !std::isfinite(t)) return none;
    const Vec3 p = ray.at(t);
    const double z = p.z() / length;
    if (!(z >= 0 && z <= 1)) return none;
    const double share = z < widest ? z / widest : (1 - z) / (1 - widest);
    return std::abs(p.x()) <= share * width / 2 ? t : none;
}

double meet(const Tree& tree, std::size_t i, const Local& ray) {
    const Vec3& size = tree.size[i];
    if (is_clump(tree, i)) {
        const double half = size.y() / 2;
        return meet_ellipsoid(ray, {0, 0, size.x() / 2}, {half, clump_depth * half, size.x() / 2});
    }
    switch (tree.kind[i]) {
    case Kind::branch:
        return meet_frustum(ray, size.x(), size.y(), size.z());
    case Kind::fruit:
        return meet_ellipsoid(ray, {0, 0, size.x()}, Vec3::Constant(size.y()));
    default:
        return meet_kite(ray, size.x(), size.y(), tree.kind[i] == Kind::petal ? 0.7 : 0.4);
    }
}

// No part of the body is farther from its joint.
double reach(const Tree& tree, std::size_t i) {
    const Vec3& size = tree.size[i];
    return size.x() + std::max(size.y(), size.z());
}

// How far a point stands off the ray, as an angle at its start.
double angle(const Local& ray, const Vec3& p) {
    const double along = (p - ray.o).dot(ray.d);
    return std::atan2((p - ray.o - along * ray.d).norm(), along);
}

// Of the axis from z = 0 to the length, the point least off the ray. With p = a + s z seen from the ray's start the cosine p.d / |p| has one
// stationary point, where (z.d)(p.p) = (p.d)(p.z), which is linear in s: s^2 cancels.
Vec3 nearest_on_axis(const Local& ray, double length) {
    const Vec3 a = -ray.o, z = Vec3::UnitZ();
    const double zd = z.dot(ray.d), ad = a.dot(ray.d), az = a.z();
    const double s = (zd * a.squaredNorm() - ad * az) / (ad - zd * az);
    Vec3 best = Vec3::Zero();
    for (const double at : {s, length})
        if (at >= 0 && at <= length && angle(ray, at * z) < angle(ray, best)) best = at * z;
    return best;
}

} // namespace

std::optional<RayHit> pick(const Tree& tree, std::span<const Vec3> positions, std::span<const Quat> rotations,
                           const Ray& ray) {
    if (!ray.from.allFinite() || !ray.direction.allFinite())
        throw SceneError("pick: the ray is not finite, expected three finite numbers each");
    const Vec3 direction = ray.direction.stableNormalized();
    if (!(direction.squaredNorm() > 0.5)) throw SceneError("pick: the ray's direction is 0, expected some length");
    if (!(ray.aperture >= 0 && ray.aperture <= std::numbers::pi / 2))
        throw SceneError("pick: aperture is " + std::to_string(ray.aperture) + " rad, expected 0 to pi / 2");

    const auto local = [&](std::size_t i) {
        const Quat back = rotations[i].conjugate();
        return Local{back * (ray.from - positions[i]), back * direction};
    };
    const auto found = [&](std::size_t i, const Vec3& point) {
        const Vec3 world = positions[i] + rotations[i] * point;
        return RayHit{i, point, world, (world - ray.from).norm()};
    };
    std::optional<RayHit> best;
    double nearest = none;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3 to = positions[i] - ray.from;
        const double along = to.dot(direction), r = reach(tree, i);
        if (along + r < 0 || along - r > nearest || !((to - along * direction).squaredNorm() <= r * r)) continue;
        const Local here = local(i);
        if (const double t = meet(tree, i, here); t < nearest) {
            nearest = t;
            best = found(i, here.at(t));
        }
    }
    if (best || ray.aperture == 0) return best;

    double least = ray.aperture;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3 to = positions[i] - ray.from;
        const double distance = to.norm(), r = tree.size[i].x();
        // From the ray's start the axis is seen within asin(r / distance) of its joint.
        if (distance > r &&
            std::acos(std::clamp(to.dot(direction) / distance, -1.0, 1.0)) > least + std::asin(r / distance))
            continue;
        const Local here = local(i);
        const Vec3 point = nearest_on_axis(here, r);
        if (const double off = angle(here, point); off <= least) {
            least = off;
            best = found(i, point);
        }
    }
    return best;
}

std::optional<RayHit> pick(const Simulation& simulation, const Ray& ray) {
    return pick(simulation.tree(), simulation.positions(), simulation.rotations(), ray);
}

} // namespace bough
