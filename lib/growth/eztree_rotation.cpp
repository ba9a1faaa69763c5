#include "eztree_rotation.h"
#include <algorithm>
#include <limits>

namespace bough::three {

Quat from_euler(const Vec3& e) {
    const Vec3 c = (e / 2).array().cos(), s = (e / 2).array().sin();
    return Quat(c.x() * c.y() * c.z() - s.x() * s.y() * s.z(), s.x() * c.y() * c.z() + c.x() * s.y() * s.z(),
                c.x() * s.y() * c.z() - s.x() * c.y() * s.z(), c.x() * c.y() * s.z() + s.x() * s.y() * c.z());
}

Vec3 to_euler(const Quat& q) {
    const Mat3 m = q.toRotationMatrix();
    const double y = std::asin(std::clamp(m(0, 2), -1.0, 1.0));
    // At a right angle x and z turn about the same axis.
    if (std::abs(m(0, 2)) < 0.9999999) return {std::atan2(-m(1, 2), m(2, 2)), y, std::atan2(-m(0, 1), m(0, 0))};
    return {std::atan2(m(2, 1), m(1, 1)), y, 0};
}

Quat slerp(const Quat& a, const Quat& b, double t) {
    if (t == 0) return a;
    if (t == 1) return b;
    double cosine = a.dot(b);
    Quat to = b;
    if (cosine < 0) {
        cosine = -cosine;
        to.coeffs() = -b.coeffs();
    }
    if (cosine >= 1) return a;
    Quat result;
    const double square = 1 - cosine * cosine;
    if (square <= std::numeric_limits<double>::epsilon()) {
        result.coeffs() = (1 - t) * a.coeffs() + t * to.coeffs();
        return result.normalized();
    }
    const double sine = std::sqrt(square), half = std::atan2(sine, cosine);
    result.coeffs() = std::sin((1 - t) * half) / sine * a.coeffs() + std::sin(t * half) / sine * to.coeffs();
    return result;
}

Quat rotate_towards(const Quat& a, const Quat& b, double step) {
    const double angle = 2 * std::acos(std::abs(std::clamp(a.dot(b), -1.0, 1.0)));
    return angle == 0 ? a : slerp(a, b, std::min(1.0, step / angle));
}

Quat y_to(const Vec3& to) {
    const double w = to.y() + 1;
    if (w < std::numeric_limits<double>::epsilon()) return Quat(0, 0, 0, 1); // half a turn, about z
    const Vec3 across = Vec3::UnitY().cross(to);
    return Quat(w, across.x(), across.y(), across.z()).normalized();
}

} // namespace bough::three
