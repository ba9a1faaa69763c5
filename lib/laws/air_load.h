// air_load.h: all that the air does to one body: the sum of its laws (air.h, leaf_air.h). Whatever steps, guards, estimates or checks a tree takes
// the air from here and only adds it up. The analytic step takes it in parts (parted_air.h); lanes have lanes/wide_air.h and wide_leaf.h.
//
// u: the wind's velocity less the body's at its centre of mass; R: world from body, or the identity where u, and AirBody::normal, are in the body's
// axes.
// The results are in the axes of u. O(1). Errors none.
#pragma once
#include "leaf_air.h"

namespace bough {

template <class T> struct AirLoad {
    Vector3<T> force;  // [N] at the centre of mass
    Vector3<T> torque; // [N m] about it, without what its own turning changes, which is
    T spin;            // [1/s] minus this times I w, I the inertia about the centre of mass, w the angular velocity
};

// Returns I [kg m^2]. J: inertia about the joint. c: the centre of mass from there.
template <class T> Matrix3<T> central_inertia(T mass, const Matrix3<T>& J, const Vector3<T>& c) {
    return J + mass * (c * c.transpose() - c.squaredNorm() * Matrix3<T>::Identity());
}

template <class T>
AirLoad<T> air_load(const AirBody<T>& body, const LeafTerms<T>& leaf, const Matrix3<T>& R, const Vector3<T>& u) {
    AirLoad<T> load{body.drag_area * air_force(body.kind, R, u, body.facing, body.normal).force, Vector3<T>::Zero(),
                    spin_rate(body.kind, body.drag_area, body.mass, u)};
    if (!has_leaf_air(leaf, body.kind)) return load;
    load.force += leaf_force(leaf, body, R, u);
    load.torque = leaf_torque(leaf, body, R, u);
    load.spin += leaf_spin(leaf);
    return load;
}

// [N s/m] Returns what stands for minus the force's derivative with the body's velocity: symmetric, positive semidefinite. times: a factor on all of
// it.
template <class T>
Matrix3<T> air_load_damping(const AirBody<T>& body, const LeafTerms<T>& leaf, const Matrix3<T>& R, const Vector3<T>& u,
                            T times = 1) {
    Matrix3<T> D = times * body.drag_area * air_damping(body.kind, R, u, body.facing, body.normal);
    if (has_leaf_air(leaf, body.kind)) D += times * leaf_damping(leaf, body, R, u);
    return D;
}

// The drag of all that a body carries (streaming_stiffness of air.h), in the axes of u.
template <class T> struct CarriedDrag {
    bool folds;       // it has foliage
    Vector3<T> first; // [kg] first moment of kappa rho A about the joint; zero: not counted
};

// [N m/rad] Adds to `turning` how fast the air's moment about the joint may change with the body's rotation, times the factor `times`.
template <class T>
void add_air_turning(const AirBody<T>& body, const LeafTerms<T>& leaf, const Matrix3<T>& R, const Vector3<T>& u,
                     const CarriedDrag<T>& carried, T times, Matrix3<T>& turning) {
    if (has_leaf_air(leaf, body.kind)) turning += times * leaf_turning(leaf, body, R, u);
    turning += times * streaming_stiffness(carried.folds, carried.first, u);
    if (is_flat(body.kind)) turning += times * body.drag_area * body.com.norm() * air_turning(body.kind, R, u);
}

// [J] Returns the most work that the air's force can do on a body in a time h, whatever the body does. Its power is at most kappa rho A times 4/27
// |U|^3 (branch, fruit, clump; at a third of the wind's speed) or |u| |U|^2 / 4 (plate). Of a clump with a face it is c_u of the one and c_n of the
// other. U: the wind's velocity. past: [m/s] |u|.
template <class T>
T air_work_bound(const AirBody<T>& body, const LeafTerms<T>& leaf, T h, const Vector3<T>& U, T past) {
    const T speed = U.norm();
    const T plate = past * speed * speed / 4, others = T(4.0 / 27) * speed * speed * speed;
    T most = is_flat(body.kind) ? plate : others;
    if (!is_flat(body.kind) && has_face(body.kind, body.facing)) {
        const Facing<T> c = facing_of(body.kind, body.facing);
        most = c.along * plate + c.all_ways * others;
    }
    const T limit = h * body.drag_area * most;
    return has_leaf_air(leaf, body.kind) ? limit + leaf_work(leaf, body, h, speed, past) : limit;
}

// The largest load of a wind u on a body that stands. Plates, which will turn into the wind, are taken broadside.
template <class T> struct AirPeak {
    Vector3<T> force; // [N]
    T own;            // [N m] of plates, about their joints, whichever way they are turned; else 0
};
template <class T>
AirPeak<T> air_peak(const AirBody<T>& body, const LeafTerms<T>& leaf, const Matrix3<T>& R, const Vector3<T>& u) {
    if (!is_flat(body.kind)) return {body.drag_area * air_force(body.kind, R, u, body.facing, body.normal).force, 0};
    const T speed = u.norm();
    const LeafPeak<T> more = has_leaf_air(leaf, body.kind) ? leaf_peak(leaf, body, speed) : LeafPeak<T>{0, 0};
    const Vector3<T> f = (body.drag_area * speed + more.force) * u;
    return {f, f.norm() * body.com.norm() + more.torque};
}

} // namespace bough
