// math.cpp: what is not a template.
#include "math.h"

namespace bough {

Quat shortest_turn(const Vec3& from, const Vec3& to) {
    // The numbers of Eigen's FromTwoVectors, but for nearly opposite directions: there Eigen divides by what rounding leaves of 1 + cosine, and for
    // opposite ones takes a singular value decomposition, which costs 5 s of a compiler's time.
    const Vec3 a = from.normalized(), b = to.normalized();
    const double cosine = b.dot(a);
    if (cosine < -0.99) {
        Vec3 axis = a.cross(b);
        axis -= a.dot(axis) * a; // what rounding made of it
        axis = axis.norm() > 1e-100 ? axis.normalized() : a.unitOrthogonal();
        const Vec3 v = (a - b).norm() / 2 * axis;
        return {(a + b).norm() / 2, v.x(), v.y(), v.z()};
    }
    const double s = std::sqrt((1 + cosine) * 2);
    const Vec3 v = a.cross(b) * (1 / s);
    return {s / 2, v.x(), v.y(), v.z()};
}

Quat least_turn(const Quat& near, const Vec3& axis) {
    const Vec3 z = near * Vec3::UnitZ();
    const Eigen::Quaterniond turn(shortest_turn(z, axis));
    return Quat((turn * Eigen::Quaterniond(near)).normalized());
}

Quat positive(const Quat& q) {
    Quat n = q.normalized();
    if (n.w() < 0) n.coeffs() *= -1;
    return n;
}

} // namespace bough
