// air.h: the air's force on a body by its velocity relative to it, one law for every solver (§7).
//
// With u the wind's velocity less the body's at its centre of mass, t its axis (z), n a plate's normal (y), all in world
// axes, the force over kappa rho A (Plan::drag_area) is
//   branch       |u_n| u_n,   u_n = u - (u.t) t        (21)
//   fruit        |u| u                                 (22)
//   leaf, petal  |u| (u.n) n                           (23), first term
#pragma once
#include "../model/body_shape.h"
#include "../model/math.h"
#include "../model/tree.h"

namespace bough {

constexpr double cylinder_drag = 1.2, sphere_drag = 0.47, plate_drag = 1.2; // C_d; kappa is half of each

// kappa rho A [kg/m]. size: as in Tree. plate_kappa: of leaves and petals, where the scene has its own.
inline double drag_area(Kind kind, const Vec3& size, double air_density, double plate_kappa = plate_drag / 2) {
    switch (kind) {
    case Kind::leaf:
    case Kind::petal:
        return plate_kappa * air_density * leaf_area(size[0], size[1]);
    case Kind::fruit:
        return sphere_drag / 2 * air_density * sphere_section(size[1]);
    case Kind::branch:
        break;
    }
    return cylinder_drag / 2 * air_density * frustum_section(size[0], size[1], size[2]);
}

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

// How fast a plate's moment about its joint may change with its rotation, over kappa rho A and the distance of its centre of
// mass: [m^2/s^2], symmetric, positive semidefinite. The moment is -|u| (u.n) x, x the width's axis, and changes by at most
// |u|^2 a radian; twice that, so that a plate held broadside to the wind, which turns at up to |u| over that distance and
// would spin round in a step, turns by half a radian at the most. Zero for the rest, whose wood is stiffer than this.
template <class T> Matrix3<T> air_turning(Kind kind, const Matrix3<T>& R_wb, const Vector3<T>& u) {
    if (!is_flat(kind)) return Matrix3<T>::Zero();
    return 2 * u.squaredNorm() * (R_wb.col(0) * R_wb.col(0).transpose());
}

} // namespace bough
