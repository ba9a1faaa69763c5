// own_inertia.h: a body's inertia about its joint, such that a step may divide by it.
#pragma once
#include "../base/math.h"
#include <limits>

namespace bough {

// Adds four roundings of the trace to J where it is singular. A body without extent about some axis (a thin rod about itself) would make the joint's
// inertia singular. The addition is below any inertia that its arithmetic can tell from none.
template <class T> Matrix3<T> own_inertia(const Matrix3<T>& J) {
    constexpr T rounding = 4 * std::numeric_limits<T>::epsilon();
    const T size = J.trace();
    if (J.determinant() > rounding / 8 * size * size * size) return J;
    return J + rounding * size * Matrix3<T>::Identity();
}

} // namespace bough
