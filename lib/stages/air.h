// air.h: the air's force on a body by its velocity relative to it, one law for every solver (§7).
//
// With u the wind's velocity less the body's at its centre of mass, t its axis (z), n a plate's normal (y), all in world
// axes, the force over kappa rho A (Plan::drag_area) is
//   branch       |u_n| u_n,   u_n = u - (u.t) t        (21)
//   fruit        |u| u                                 (22)
//   leaf, petal  |u| (u.n) n                           (23), first term
#pragma once
#include "../model/math.h"
#include "../model/tree.h"

namespace bough {

template <class T> struct AirForce {
    Vector3<T> force; // [m^2/s^2] over kappa rho A
    T speed;          // [m/s] that scales it: |u_n| or |u|
};

template <class T> AirForce<T> air_force(Kind kind, const Matrix3<T>& R_wb, const Vector3<T>& u) {
    if (kind == Kind::branch) {
        const Vector3<T> t = R_wb.col(2);
        const Vector3<T> across = u - u.dot(t) * t;
        const T speed = across.norm();
        return {speed * across, speed};
    }
    const T speed = u.norm();
    if (kind == Kind::fruit) return {speed * u, speed};
    const Vector3<T> normal = R_wb.col(1);
    return {speed * u.dot(normal) * normal, speed};
}

// Minus the force's derivative with the body's velocity, over kappa rho A [m/s]: symmetric, positive semidefinite. Exact for
// branches and fruit; of a plate's derivative the part along its normal, which is the stiff one.
template <class T> Matrix3<T> air_damping(Kind kind, const Matrix3<T>& R_wb, const Vector3<T>& u) {
    if (is_flat(kind)) {
        const Vector3<T> n = R_wb.col(1);
        const T speed = u.norm(), along = u.dot(n);
        return (speed > 0 ? speed + along * along / speed : T(0)) * (n * n.transpose());
    }
    Vector3<T> across = u;
    Matrix3<T> plane = Matrix3<T>::Identity();
    if (kind == Kind::branch) {
        const Vector3<T> t = R_wb.col(2);
        across -= u.dot(t) * t;
        plane -= t * t.transpose();
    }
    const T speed = across.norm();
    if (!(speed > 0)) return Matrix3<T>::Zero();
    return speed * plane + across * across.transpose() / speed;
}

// How a plate turns with the wind like a vane: minus the derivative of the moment about its joint with its rotation, over kappa
// rho A and the distance of its centre of mass: [m^2/s^2]. The moment is -|u| (u.n) x (x the width's axis, c along z), so the
// symmetric part is |u| sym(x (n x u)^T) = |u| [u_z, -u_x/2; -u_x/2, 0] in x, z, of eigenvalues (u_z +- |(u_x, u_z)|) / 2. The positive one,
// which pulls a plate behind its joint, is returned, as an implicit step can take it; the other turns it over. Zero for
// the rest, whose wood is stiffer than this.
template <class T> Matrix3<T> air_turning(Kind kind, const Matrix3<T>& R_wb, const Vector3<T>& u) {
    if (!is_flat(kind)) return Matrix3<T>::Zero();
    const T ux = u.dot(R_wb.col(0)), uz = u.dot(R_wb.col(2));
    const T in_plane = std::sqrt(ux * ux + uz * uz);
    // (u_z + |.|) / 2 without the cancellation where the wind comes from ahead.
    const T lambda = uz >= 0 ? (uz + in_plane) / 2 : ux * ux / (2 * (in_plane - uz));
    const Vector3<T> v = 2 * lambda * R_wb.col(0) - ux * R_wb.col(2);
    const T size = v.squaredNorm();
    if (!(size > 0)) return Matrix3<T>::Zero();
    return (u.norm() * lambda / size) * (v * v.transpose());
}

} // namespace bough
