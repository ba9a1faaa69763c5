// math.h: vectors, matrices, quaternions, and the two maps between a rotation vector and a rotation.
//
// Everything is right-handed. R_ab takes components in frame b to components in frame a, so neighbours cancel:
// R_wc = R_wp * R_pj * R_jc. Suffix _w: world, _b: body, _j: joint frame.
#pragma once
#include "eager.h"
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

namespace bough {

template <class T> using Quaternion = Eigen::Quaternion<T, Eigen::DontAlign>;

using Vec3 = Vector3<double>;
using Mat3 = Matrix3<double>;
using Quat = Quaternion<double>;

// Returns the cross-product matrix r*: cross_matrix(r) * f == r.cross(f).
template <class T> Matrix3<T> cross_matrix(const Vector3<T>& r) {
    Matrix3<T> m;
    m << T(0), -r.z(), r.y(), r.z(), T(0), -r.x(), -r.y(), r.x(), T(0);
    return m;
}

// Returns the rotation of |theta| radians about theta (Rodrigues). It takes series below 1e-2 rad, where 1 - cos loses its digits.
template <class T> Matrix3<T> rotation_from_vector(const Vector3<T>& theta) {
    const T a2 = theta.squaredNorm();
    const T a = std::sqrt(a2);
    const bool small = a < T(1e-2);
    // sin(a)/a and (1 - cos a)/a^2 = 2 sin^2(a/2)/a^2; both even in a.
    const T s = small ? T(1) - a2 / T(6) * (T(1) - a2 / T(20)) : std::sin(a) / a;
    const T h = std::sin(a / T(2));
    const T c = small ? T(0.5) - a2 / T(24) * (T(1) - a2 / T(30)) : T(2) * h * h / a2;
    const Matrix3<T> x = cross_matrix(theta);
    return Matrix3<T>::Identity() + s * x + c * (x * x);
}

template <class T> Quaternion<T> quaternion_from_vector(const Vector3<T>& theta) {
    const T a = theta.norm();
    const T half = a / T(2);
    const T s = a < T(1e-4) ? T(0.5) - a * a / T(48) : std::sin(half) / a;
    return Quaternion<T>(std::cos(half), s * theta.x(), s * theta.y(), s * theta.z());
}

// Returns the rotation vector of a unit quaternion, |theta| <= pi.
template <class T> Vector3<T> vector_from_quaternion(const Quaternion<T>& q) {
    const T sign = q.w() < T(0) ? T(-1) : T(1);
    const Vector3<T> v = sign * q.vec();
    const T n = v.norm();
    if (n < T(1e-8)) return T(2) * v;
    return (T(2) * std::atan2(n, sign * q.w()) / n) * v;
}

// Makes theta a vector of at most half a turn for the same rotation: past pi it becomes the rotation the other way round. Returns true if it was past
// pi.
template <class T> bool shorten_rotation(Vector3<T>& theta) {
    constexpr T pi = T(3.14159265358979323846);
    const T angle = theta.norm();
    if (!(angle > pi) || !std::isfinite(angle)) return false;
    theta *= std::remainder(angle, 2 * pi) / angle;
    return true;
}

// Returns J: body rates from the rates of a rotation vector, omega_b = J theta_dot for R_jb = exp(theta) (the right Jacobian of SO(3); in the joint
// frame omega_j = J^T theta_dot). J = 1 - a theta* + c theta* theta*.
template <class T> Matrix3<T> body_rate_jacobian(const Vector3<T>& theta) {
    const T a2 = theta.squaredNorm();
    const T a = std::sqrt(a2);
    const T h = std::sin(a / T(2));
    const bool small = a < T(0.1);
    const T first = small ? T(0.5) - a2 / T(24) * (T(1) - a2 / T(30) * (T(1) - a2 / T(56))) : T(2) * h * h / a2;
    const T second =
        small ? T(1) / T(6) - a2 / T(120) * (T(1) - a2 / T(42) * (T(1) - a2 / T(72))) : (a - std::sin(a)) / (a2 * a);
    const Matrix3<T> x = cross_matrix(theta);
    return Matrix3<T>::Identity() - first * x + second * (x * x);
}

// Returns T = J^-1: theta_dot = T omega_b. It is finite up to |theta| = 2 pi, where J is singular.
template <class T> Matrix3<T> body_rate_jacobian_inverse(const Vector3<T>& theta) {
    const T a2 = theta.squaredNorm();
    const T a = std::sqrt(a2);
    const T c = a < T(0.1) ? T(1) / T(12) + a2 / T(720) * (T(1) + a2 / T(42) * (T(1) + a2 / T(40)))
                           : (T(1) - a / T(2) * std::cos(a / T(2)) / std::sin(a / T(2))) / a2;
    const Matrix3<T> x = cross_matrix(theta);
    return Matrix3<T>::Identity() + T(0.5) * x + c * (x * x);
}

// Returns the shortest turn that brings the direction of `from` to that of `to` (unit length not needed). For opposite ones it is half a turn.
Quat shortest_turn(const Vec3& from, const Vec3& to);

// Returns a frame whose z axis is `axis` (unit length not needed), turned the least from `near`'s own z axis. Branch bodies take their frames this
// way along the branch, so that x and y do not spin about it (a twist-free frame).
Quat least_turn(const Quat& near, const Vec3& axis);

// Returns q / |q| or its opposite, which stands for the same rotation: the one with w >= 0.
Quat positive(const Quat& q);

} // namespace bough
