// leaf_air.h: what the air does to a leaf or petal beyond air.h, where the scene has /leaves: (23)'s second term and the torque (24).
// air_load.h and parted_air.h add it to air.h's. Flying leaves have their own header (leaf_card.h), lanes theirs (lanes/wide_leaf.h).
//
// u is the wind's velocity less the body's at its centre of mass, n the normal (y), u_n = (u.n) n, u_t = u - u_n, I the inertia about the centre of
// mass, s = kappa rho A (Plan::drag_area), m the mass. All are in one frame, world or the body's:
//   force    nu m (u_n + u_t / xi)
//   torque   k (u.n) n x (u cos phi + n x u sin phi) - nu I w,   k = kappa rho A/2 sqrt(A/pi) = s^3/2 / (2 sqrt(pi kappa rho))
// Both are stable at any step. The force is linear in the velocity, so its damping is exact; so is nu I w. With the velocity, the first torque
// changes by at most 2 k |u|. At the arm c of a leaf's centre of mass that is sqrt(A/pi) / c of what the pressure's own damping takes, s |u| c^2, in
// its worst direction, a wind along the surface from the tip; mostly it is far less. So that damping covers it, and the torque has none of its own.
// With rotation the torque changes by at most k |u|^2 a radian, and the force's moment by nu m |u| c. As in air.h, leaf_turning allows for twice
// that.
#pragma once
#include "../base/math.h"
#include "../model/scene.h"
#include "air.h"
#include "leaf_terms.h"
#include <algorithm>
#include <numbers>

namespace bough {

// Returns kappa of leaves and petals: the scene's own, or half a plate's drag coefficient.
inline double plate_kappa(const Scene& scene) {
    return scene.leaves ? scene.leaves->kappa : plate_drag / 2;
}

// Returns the terms; they are off where the scene has no /leaves.
template <class T> LeafTerms<T> leaf_terms(const Scene& scene) {
    LeafTerms<T> terms;
    if (!scene.leaves) return terms;
    const LeafAir& air = *scene.leaves;
    const double pressed = air.kappa * scene.air_density, offset = air.offset * std::numbers::pi / 180;
    terms.on = true;
    terms.across = T(air.air_resistance);
    terms.along = T(air.air_resistance / air.drag_ratio);
    terms.most = std::max(terms.across, terms.along);
    terms.torque = pressed > 0 ? T(0.5 / std::sqrt(std::numbers::pi * pressed)) : T(0);
    terms.cos_offset = T(std::cos(offset));
    terms.sin_offset = T(std::sin(offset));
    return terms;
}

// True if these terms act on a body of this kind.
template <class T> bool has_leaf_air(const LeafTerms<T>& terms, Kind kind) {
    return terms.on && is_flat(kind);
}

// Returns k [kg] of a body with s = drag_area [kg/m].
template <class T> T leaf_lever(const LeafTerms<T>& terms, T drag_area) {
    return terms.torque * drag_area * std::sqrt(drag_area);
}

// [N]
template <class T>
Vector3<T> leaf_force(const LeafTerms<T>& terms, const AirBody<T>& body, const Matrix3<T>& R, const Vector3<T>& u) {
    const Vector3<T> n = R.col(1);
    return body.mass * (terms.along * u + (terms.across - terms.along) * u.dot(n) * n);
}

// [N] Returns how the force changes when the air goes past the body at `moving` instead of `still`.
template <class T>
Vector3<T> leaf_drag(const LeafTerms<T>& terms, const AirBody<T>& body, const Matrix3<T>& R, const Vector3<T>& still,
                     const Vector3<T>& moving) {
    return leaf_force(terms, body, R, Vector3<T>(moving - still)); // it is linear
}

// Returns minus the force's derivative with the body's velocity [N s/m].
template <class T>
Matrix3<T> leaf_damping(const LeafTerms<T>& terms, const AirBody<T>& body, const Matrix3<T>& R,
                        const Vector3<T>& /*u*/) {
    const Vector3<T> n = R.col(1);
    return body.mass * (terms.along * Matrix3<T>::Identity() + (terms.across - terms.along) * n * n.transpose());
}

// [N m] Returns the torque without nu I w.
template <class T>
Vector3<T> leaf_torque(const LeafTerms<T>& terms, const AirBody<T>& body, const Matrix3<T>& R, const Vector3<T>& u) {
    const Vector3<T> n = R.col(1), turning = n.cross(u);
    return leaf_lever(terms, body.drag_area) * u.dot(n) *
           (terms.cos_offset * turning + terms.sin_offset * n.cross(turning));
}

// [1/s] nu
template <class T> T leaf_spin(const LeafTerms<T>& terms) {
    return terms.across;
}

// Returns how fast both moments about the joint may change with rotation [N m/rad]: symmetric, positive semidefinite.
template <class T>
Matrix3<T> leaf_turning(const LeafTerms<T>& terms, const AirBody<T>& body, const Matrix3<T>& R, const Vector3<T>& u) {
    const Vector3<T> n = R.col(1), axis = R.col(2);
    const Matrix3<T> one = Matrix3<T>::Identity();
    return 2 * leaf_lever(terms, body.drag_area) * u.squaredNorm() * (one - n * n.transpose()) +
           2 * body.mass * terms.most * body.com.norm() * u.norm() * (one - axis * axis.transpose());
}

// [J] Returns the most work that the force can do in a time h, whatever the body does: nu m |U|^2 / 4, U the wind's velocity. past: |u|. It leaves
// out the torque's work: energy_guard.h takes back what the torque puts into a leaf that turns fast.
template <class T> T leaf_work(const LeafTerms<T>& terms, const AirBody<T>& body, T h, T speed, T /*past*/) {
    return h * body.mass * terms.most * (speed * speed / 4);
}

// Bounds of parted_air.h.
template <class T> struct LeafBounds { T drag, wind, turn; };
// arm: [m] at which torques are taken. still, moving: speeds past the body as it stands and as it goes.
template <class T>
LeafBounds<T> leaf_bounds(const LeafTerms<T>& terms, const AirBody<T>& body, T arm, T still, T moving) {
    const T resisted = body.mass * terms.most, pressed = leaf_lever(terms, body.drag_area) / arm;
    return {resisted + pressed * (moving + still), resisted, 2 * still * (resisted + pressed * still)};
}

// The most that a wind of this speed can do, however the leaf is turned: force over the speed [N s/m], torque [N m].
template <class T> struct LeafPeak { T force, torque; };
template <class T> LeafPeak<T> leaf_peak(const LeafTerms<T>& terms, const AirBody<T>& body, T speed) {
    return {body.mass * terms.most, leaf_lever(terms, body.drag_area) * speed * speed};
}

} // namespace bough
