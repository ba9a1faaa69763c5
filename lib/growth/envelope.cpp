#include "envelope.h"
#include <numbers>
#include <stdexcept>

namespace bough {
namespace {

enum class EnvelopeDraw : std::uint8_t { u, v, w };

constexpr std::uint64_t kTries = 1'000'000;

// Fractional parts of multiples of 1/g, 1/g^2, 1/g^3 with g^4 = g + 1: evenly spread in the unit cube.
Vec3 spread(int i) {
    constexpr double g = 1.2207440846057596;
    const auto part = [i](double a) { return 0.5 + i * a - std::floor(0.5 + i * a); };
    return {part(1 / g), part(1 / (g * g)), part(1 / (g * g * g))};
}

} // namespace

void check_envelope(const Envelope& e) {
    if (e.shape == EnvelopeShape::mesh) {
        if (!e.mesh) throw std::invalid_argument("envelope: has no mesh, expected one");
        return;
    }
    if (!(e.size.minCoeff() > 0) || !e.size.allFinite() || !e.base.allFinite())
        throw std::invalid_argument("envelope size: expected three lengths above 0 m");
}

Vec3 lower_corner(const Envelope& e) {
    if (e.shape == EnvelopeShape::mesh) return e.mesh->lower();
    return e.base - Vec3(e.size.x() / 2, 0, e.size.z() / 2);
}

Vec3 upper_corner(const Envelope& e) {
    if (e.shape == EnvelopeShape::mesh) return e.mesh->upper();
    return e.base + Vec3(e.size.x() / 2, e.size.y(), e.size.z() / 2);
}

bool contains(const Envelope& e, const Vec3& point) {
    if (e.shape == EnvelopeShape::mesh) return e.mesh->contains(point);
    const Vec3 p = (point - e.base).cwiseQuotient(e.size); // y in 0..1, x and z in -1/2..1/2
    switch (e.shape) {
    case EnvelopeShape::sphere:
        return Vec3(p.x(), p.y() - 0.5, p.z()).squaredNorm() <= 0.25;
    case EnvelopeShape::cone:
        return p.y() >= 0 && p.y() <= 1 && 2 * std::hypot(p.x(), p.z()) <= 1 - p.y();
    default:
        return p.y() >= 0 && p.y() <= 1 && std::abs(p.x()) <= 0.5 && std::abs(p.z()) <= 0.5;
    }
}

Vec3 point_inside(const Envelope& e, RandomKey key, std::uint64_t index) {
    if (e.shape == EnvelopeShape::mesh) {
        const Vec3 lower = e.mesh->lower(), size = e.mesh->upper() - lower;
        const RandomKey own = random_key(key, EnvelopeDraw::u, index);
        for (std::uint64_t i = 0; i < kTries; ++i) {
            const Vec3 unit(random_unit(own, EnvelopeDraw::u, i), random_unit(own, EnvelopeDraw::v, i),
                            random_unit(own, EnvelopeDraw::w, i));
            const Vec3 p = lower + unit.cwiseProduct(size);
            if (e.mesh->contains(p)) return p;
        }
        throw std::invalid_argument(
            "envelope: none of 1e6 points of its bounding box is inside, expected a closed mesh");
    }
    const double u = random_unit(key, EnvelopeDraw::u, index), v = random_unit(key, EnvelopeDraw::v, index),
                 w = random_unit(key, EnvelopeDraw::w, index);
    Vec3 p(u - 0.5, v, w - 0.5);
    const double turn = 2 * std::numbers::pi * w;
    if (e.shape == EnvelopeShape::sphere) {
        const double r = 0.5 * std::cbrt(u), up = 2 * v - 1, across = std::sqrt(1 - up * up);
        p = Vec3(r * across * std::cos(turn), 0.5 + r * up, r * across * std::sin(turn));
    } else if (e.shape == EnvelopeShape::cone) {
        const double below = std::cbrt(u), r = 0.5 * below * std::sqrt(v);
        p = Vec3(r * std::cos(turn), 1 - below, r * std::sin(turn));
    }
    return e.base + p.cwiseProduct(e.size);
}

double volume(const Envelope& e) {
    const double box = e.size.prod();
    switch (e.shape) {
    case EnvelopeShape::sphere:
        return std::numbers::pi / 6 * box;
    case EnvelopeShape::cone:
        return std::numbers::pi / 12 * box;
    case EnvelopeShape::box:
        return box;
    default:
        break;
    }
    if (e.space > 0) return e.space;
    constexpr int points = 1 << 15;
    const Vec3 lower = e.mesh->lower(), size = e.mesh->upper() - lower;
    int inside = 0;
    for (int i = 0; i < points; ++i) inside += e.mesh->contains(lower + spread(i).cwiseProduct(size));
    return size.prod() * inside / points;
}

} // namespace bough
