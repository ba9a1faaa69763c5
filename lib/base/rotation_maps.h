// rotation_maps.h: a rotation vector's rotation, rates and their derivative together, from one sine and cosine.
//
// With X = theta* and a = |theta|, in the axes that theta is given in (the joint frame):
//   exp(theta) = 1 + s X + c1 X^2            s = sin a / a,  c1 = (1 - cos a) / a^2
//   J = 1 + c1 X + c2 X^2                    c2 = (a - sin a) / a^3: the left Jacobian of SO(3), omega_j = J theta_dot
//   T = J^-1 = 1 - X/2 + t2 X^2              t2 = (1 - (a/2) cot(a/2)) / a^2
//   J_dot eta = c1' theta x eta + c2' theta x (theta x eta) + c2 eta x (theta x eta),  eta = theta_dot,
//     c1' = (s - 2 c1) / a^2 (theta.eta), c2' = (c1 - 3 c2) / a^2 (theta.eta)
// (math.h's body_rate_jacobian is the transpose of this J.) Small a takes series. T is finite up to a = 2 pi.
#pragma once
#include "math.h"

namespace bough {

template <class T> struct RotationMaps {
    Matrix3<T> R;            // exp(theta)
    Matrix3<T> J, J_inverse; // J and its inverse
    T c2, dc1, dc2;          // dc1, dc2: c1', c2' over theta.eta
    Vector3<T> theta;

    Vector3<T> rate_bias(const Vector3<T>& eta) const { // J_dot eta
        const Vector3<T> cross = theta.cross(eta);
        return theta.dot(eta) * (dc1 * cross + dc2 * theta.cross(cross)) + c2 * eta.cross(cross);
    }
};

template <class T> RotationMaps<T> rotation_maps(const Vector3<T>& theta) {
    const T a2 = theta.squaredNorm();
    const T a = std::sqrt(a2);
    RotationMaps<T> m;
    m.theta = theta;
    T s, c1, t2;
    if (a < (sizeof(T) == 4 ? T(0.5) : T(0.1))) { // above, the quotients keep their digits
        s = 1 - a2 / 6 * (1 - a2 / 20 * (1 - a2 / 42));
        c1 = T(0.5) - a2 / 24 * (1 - a2 / 30 * (1 - a2 / 56));
        m.c2 = T(1) / 6 - a2 / 120 * (1 - a2 / 42 * (1 - a2 / 72));
        t2 = T(1) / 12 + a2 / 720 * (1 + a2 / 42 * (1 + a2 / 40));
        m.dc1 = -T(1) / 12 + a2 / 180 * (1 - a2 * T(3) / 112 * (1 - a2 / T(67.5)));
        m.dc2 = -T(1) / 60 + a2 / 1260 * (1 - a2 / 48 * (1 - a2 / T(82.5)));
    } else {
        const T half = std::sin(a / 2), cosine = std::cos(a / 2);
        s = 2 * half * cosine / a;
        c1 = 2 * half * half / a2;
        m.c2 = (1 - s) / a2;
        t2 = (1 - a / 2 * cosine / half) / a2;
        m.dc1 = (s - 2 * c1) / a2;
        m.dc2 = (c1 - 3 * m.c2) / a2;
    }
    const Matrix3<T> X = cross_matrix(theta), X2 = X * X;
    const Matrix3<T> one = Matrix3<T>::Identity();
    m.R = one + s * X + c1 * X2;
    m.J = one + c1 * X + m.c2 * X2;
    m.J_inverse = one - T(0.5) * X + t2 * X2;
    return m;
}

} // namespace bough
