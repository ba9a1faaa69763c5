#include "nearest_vector.h"
#include <numbers>

namespace bough {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double no_axis = 1e-6; // [rad] below this a rotation does not tell its axis, as given unit quaternions go

} // namespace

Vec3 nearest_vector(const Quat& q, const Vec3& before) {
    const Vec3 small = vector_from_quaternion(q);
    const double a = small.norm(), length = before.norm();
    if (a < no_axis) {
        const double whole = std::round(length / turn);
        return whole > 0 ? Vec3(before * (whole * turn / length)) : small;
    }
    const Vec3 axis = small / a;
    const double whole = std::round((axis.dot(before) - a) / turn);
    return whole == 0 ? small : Vec3((a + whole * turn) * axis);
}

} // namespace bough
