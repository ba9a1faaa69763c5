// parted_air.h: all that the air does to one body (air_load.h), in two parts as the analytic step takes it (analytic/external_forces.h): the load on
// the body at rest, and what the body's own motion changes of it, with its bounds.
//
// A body is at rest here when it is at rest on its tree's ground. The second part of the force is at most drag |v| with drag = kappa rho A (|u| + |u
// at rest|) (|u_n| for branches), since || u|u - w|w| || <= (|u| + |w|) |u - w|. The part at rest falls by wind = kappa rho A |u at rest|, over the
// speed, from rest to going with the wind. Of a clump both are c_n + c_u (air.h) times that. With the body's direction the part at rest changes by at
// most turn = 3, 2, 1, c_u + c_n (branch, leaf, fruit, clump) times kappa rho A |u at rest|^2 a radian. Force and arm turn with it; of fruit and
// clumps the arm alone.
// With /leaves a leaf's resistance and torque (leaf_air.h) are parted likewise and add to the same bounds. To drag they add nu m and 2 k |u| over the
// arm (and nu I, as what it is at that arm), to wind nu m, to turn twice their moments over the arm. The square of the arm,
// AnalyticPlan::com_distance, then holds the square of the centre of mass's distance and that of the radius of gyration.
#pragma once
#include "air_load.h"
#include <algorithm>

namespace bough {

template <class T> struct PartedAir {
    Vector3<T> force, torque;           // [N], [N m about the joint] on the body at rest
    Vector3<T> drag_force, drag_torque; // of its motion
    T drag, wind;                       // [N s/m]
    T turn;                             // [N/rad]
};

// All are in world axes.
template <class T> struct AirPast {
    Vector3<T> still, moving; // [m/s] the air's velocity past the body at rest on its ground, and as it goes
    Vector3<T> turning;       // [rad/s] that ground's
    Vector3<T> omega;         // [rad/s] the body's; of foliage alone
};

// R: world from body. J: [kg m^2] inertia about the joint, body axes. arm: [m] at which bounds of torques are taken.
template <class T>
PartedAir<T> parted_air(const AirBody<T>& body, const LeafTerms<T>& leaf, const Matrix3<T>& R, const Matrix3<T>& J,
                        T arm, const AirPast<T>& air) {
    const Vector3<T> c = R * body.com;
    const AirForce<T> still = air_force(body.kind, R, air.still, body.facing, body.normal),
                      moving = air_force(body.kind, R, air.moving, body.facing, body.normal);
    const Facing<T> face = facing_of(body.kind, body.facing);
    const T scale = body.drag_area, most = (face.along + face.all_ways) * scale; // of any direction
    PartedAir<T> load;
    load.force = scale * still.force;
    load.torque = c.cross(load.force);
    load.drag_force = scale * (moving.force - still.force);
    load.drag_torque = c.cross(load.drag_force);
    load.drag = most * (moving.speed + still.speed);
    const T pressing = is_foliage(body.kind) ? still.speed : air.still.norm();
    load.wind = most * pressing;
    // Force and arm both turn: the change is twice the force for a plate, three times for |u_n| u_n; of spheres and clumps only the arm turns.
    const T turns = body.kind == Kind::branch ? T(3) : is_flat(body.kind) ? T(2) : face.all_ways + face.along;
    load.turn = turns * scale * pressing * air.still.norm();
    if (!is_foliage(body.kind)) return load;

    const bool on = has_leaf_air(leaf, body.kind);
    const T rate = spin_rate(body.kind, scale, body.mass, air.moving) + (on ? leaf_spin(leaf) : T(0));
    const Matrix3<T> I = rate * central_inertia(body.mass, J, body.com);
    const Vector3<T> omega = air.omega - air.turning;
    load.torque -= R * (I * (R.transpose() * air.turning));
    load.drag_torque -= R * (I * (R.transpose() * omega));
    const T far = std::max(arm, T(1e-9));
    load.drag += body.mass * rate * (1 - body.com.squaredNorm() / (far * far)); // rate I is at most this times far^2
    if (!on) return load;

    const Vector3<T> f = leaf_force(leaf, body, R, air.still), at_rest = leaf_torque(leaf, body, R, air.still);
    const Vector3<T> drag_f = leaf_drag(leaf, body, R, air.still, air.moving);
    load.force += f;
    load.torque += c.cross(f) + at_rest;
    load.drag_force += drag_f;
    load.drag_torque += c.cross(drag_f) + leaf_torque(leaf, body, R, air.moving) - at_rest;
    const LeafBounds<T> bounds = leaf_bounds(leaf, body, far, air.still.norm(), air.moving.norm());
    load.drag += bounds.drag;
    load.wind += bounds.wind;
    load.turn += bounds.turn;
    return load;
}

} // namespace bough
