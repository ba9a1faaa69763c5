// air.h: the air's force on a body from its velocity relative to the body, one law for every solver (§7).
//
// u is the wind's velocity less the body's at its centre of mass, t the body's axis (z), n a plate's normal (y), all in world axes. The force over
// kappa rho A (Plan::drag_area) is
//   branch       |u_n| u_n,   u_n = u - (u.t) t        (21)
//   fruit        |u| u                                 (22)
//   leaf, petal  |u| ((1 - s) (u.n) n + s u)           (23), first term, and the part s that needs no angle of attack
//   clump        |u| (c_n (u.n) n + c_u u)
// s is streaming_drag: a blade that streams with the wind still has the drag of its curled and rough surface. A clump (tree.h) has the mean of its
// leaves' law. Of their normals m the mean of m m^T is taken for (1 - f)/3 1 + f n n^T, f its Tree::leaf_facing, n the upright: as it leans, its
// leaves turn about their stalks. Its A is blade_mean of theirs, so that
//   c_n = f (1 - s) / blade_mean,   c_u = 1 - f (1 - s / blade_mean)
// Where f is 0 they face all ways, and it meets the air as fruit does. The mean of its drag over all directions does not depend on f.
// Folding. Leaves roll up and clumps close as the wind rises (Vogel, J. Exp. Bot. 40:941, 1989). Their drag goes with |u|^(2 + E), with Vogel's E
// between -0.5 and -1 at 5 to 20 m/s. All of their force is multiplied by G; G is 1 for wood and fruit. Of a leaf G = g = 1 / (1 + |u| / fold_speed).
// g alone gives E = -(1 - g); the rest comes from blades that turn with the wind. In a clump they do so unseen, so that its G is g h,
//   h = p + (1 - p) / (1 + (|u| / stream_speed)^4),   p = streamed
// which is fitted to what the leaves of whole trees have of the drag that they would have as drawn, in steady winds:
//                                    4 m/s   6 m/s   8 m/s   12 m/s   20 m/s
//   birch                            1.01    0.84    0.74    0.63     0.59
//   apple                            1.07    0.96    0.83    0.71     0.64
//   cherry                           1.11    0.94    0.81    0.69     0.65
//   maple                            1.06    0.85    0.76    0.71     0.69
//   h                                0.97    0.89    0.79    0.70     0.67
// Those are treegen's whole trees of seed 0, after 6 s of a wind that is the same at all heights. Narrow leaves hardly turn: a pine's needles have
// 1.00, 0.96 and 0.76 at 4, 8 and 16 m/s, a palm's leaflets 1.00. Many of these are a tuft, a clump with h = 1.
// The stiffness by drag (streaming_stiffness) is that of leaves that do not turn, for clumps too. With a clump's own G the error of the default step
// was 0.90 to 1.16 times as large (oak, maple; 300 and 3 000 bodies; gusty, storm): it is not made.
// The mean drag [N] in a steady wind is then, and E from 5 to 20 m/s
//                                     5 m/s    10 m/s   20 m/s   E        of the foliage alone
//   a leaf of 9 cm, all directions    0.0149   0.0315   0.0605   -0.99
//   a clump of 14, 30 cm              0.159    0.356    0.823    -0.81
//   maple, whole (98 000 bodies)      3080     8240     24800    -0.49    -0.87
//   the same on 1 000                 3150     7670     20100    -0.66    -0.81
//   birch on 1 000                    829      2070     5640     -0.62    -0.82
// More of the whole tree's drag is that of bare wood, which does not fold: clumps hold their twigs, which fold with them (growth/resolve.h).
// tests/lib/laws/foliage.cpp holds leaf, clump and a crown's foliage within -0.5 and -1.
// Turning. A blade that turns by itself, its centre of mass at rest, meets the air at its edges. This gives a torque
//   -k G |u| (kappa rho A / m) I w,   I the inertia about the centre of mass
// I / m is the blade's second moments of area over its area. So k = 1 is the normal force (23), strip by strip. Thin plates have more. Potential flow
// without the circulation that a fast turn does not build up gives pi/2 rho |u| b^3 a unit of span, b half the chord (Fung, Theory of Aeroelasticity,
// 6.9): k = 3.9. They have half as much again as they swing in their own wake, where plates' drag is 1.5 to 3 times the steady one (Keulegan,
// Carpenter, J. Res. Natl. Bur. Stand. 60:423, 1958): k = 6. In a clump the drag of all leaves grows with |u|: the strips give 4/3, with half as much
// again k = 2.
#pragma once
#include "../base/math.h"
#include "../model/air_constants.h"
#include "../model/body_shape.h"
#include "../model/tree.h"
#include <algorithm>

namespace bough {

// Returns kappa rho A [kg/m]. size: as in Tree. plate_kappa: kappa of leaves and petals, where the scene has its own.
inline double drag_area(Kind kind, const Vec3& size, double air_density, double plate_kappa = plate_drag / 2) {
    switch (kind) {
    case Kind::leaf:
    case Kind::petal:
        return plate_kappa * air_density * leaf_area(size[0], size[1]);
    case Kind::clump:
    case Kind::tuft:
        return blade_mean * plate_kappa * air_density * leaf_area(size[0], size[1]);
    case Kind::fruit:
        return sphere_drag / 2 * air_density * sphere_section(size[1]);
    case Kind::branch:
        break;
    }
    return cylinder_drag / 2 * air_density * frustum_section(size[0], size[1], size[2]);
}

// The same for a body of the tree, by the law of `kind`, with what is part of the body and not in its size (Tree::drag).
inline double drag_area(const Tree& tree, std::size_t i, Kind kind, double air_density,
                        double plate_kappa = plate_drag / 2) {
    return (tree.drag.empty() ? 1 : tree.drag[i]) * drag_area(kind, tree.size[i], air_density, plate_kappa);
}

// What the laws take of a body.
template <class T> struct AirBody {
    Kind kind;
    T drag_area;                             // [kg/m] kappa rho A
    T mass;                                  // [kg]
    Vector3<T> com;                          // [m] centre of mass from the joint, body frame
    T facing = 0;                            // [1] f, Tree::leaf_facing of a clump
    Vector3<T> normal = Vector3<T>::UnitY(); // n of a clump, in the axes of u: the world's upright
};

// A blade of this width over length as it meets the air in the mean over its own motion, in which a broad one turns with the wind: a clump of one,
// which faces its way. Other bodies are as they are.
template <class T> AirBody<T> streaming(const AirBody<T>& body, double proportion, const Matrix3<T>& R_wb) {
    if (!is_flat(body.kind)) return body;
    return {kind_of_many(proportion), T(blade_mean) * body.drag_area, body.mass, body.com, T(1), R_wb.col(1)};
}

template <class T> struct AirForce {
    Vector3<T> force; // [m^2/s^2] over kappa rho A
    T speed;          // [m/s] that scales it: |u_n| or G |u|
};

// G
template <class T> T unfolded(Kind kind, T speed) {
    return unfolding(kind, speed).share;
}

// The law's factors of (u.n) n and of u. facing: f.
template <class T> struct Facing { T along, all_ways; };
template <class T> Facing<T> facing_of(Kind kind, T facing) {
    if (is_flat(kind)) return {T(1 - streaming_drag), T(streaming_drag)};
    return {T(facing_along) * facing, 1 - T(facing_less) * facing};
}
// True for a body whose force depends on its normal.
template <class T> bool has_face(Kind kind, T facing) {
    return is_flat(kind) || (stands_for_many(kind) && facing > 0);
}

// R_wb: world from body; or, as for all that is below, the identity where u, and normal, are in the body's axes. facing, normal: of a clump
// (AirBody).
template <class T>
AirForce<T> air_force(Kind kind, const Matrix3<T>& R_wb, const Vector3<T>& u, T facing = 0,
                      const Vector3<T>& normal = Vector3<T>::UnitY()) {
    if (kind == Kind::branch) {
        const Vector3<T> t = R_wb.col(2);
        const Vector3<T> across = u - u.dot(t) * t;
        const T speed = across.norm();
        return {speed * across, speed};
    }
    const T speed = u.norm() * unfolded(kind, u.norm());
    if (!has_face(kind, facing)) return {speed * u, speed};
    const Facing<T> c = facing_of(kind, facing);
    const Vector3<T> n = is_flat(kind) ? Vector3<T>(R_wb.col(1)) : normal;
    return {speed * (c.along * u.dot(n) * n + c.all_ways * u), speed};
}

// Returns minus the force's derivative with the body's velocity, over kappa rho A [m/s]: symmetric, positive semidefinite. It is exact for branches
// and fruit. For what has a face it keeps a symmetric part of the derivative: that of (u.n) n along the normal alone.
template <class T>
Matrix3<T> air_damping(Kind kind, const Matrix3<T>& R_wb, const Vector3<T>& u, T facing = 0,
                       const Vector3<T>& normal = Vector3<T>::UnitY()) {
    if (kind != Kind::branch) {
        const T U = u.norm();
        if (!(U > 0)) return Matrix3<T>::Zero();
        const Unfolding<T> G = unfolding(kind, U);
        const T speed = G.share * U, more = G.slope / U;
        const Matrix3<T> all_ways = speed * Matrix3<T>::Identity() + more * (u * u.transpose());
        if (!has_face(kind, facing)) return all_ways;
        const Facing<T> c = facing_of(kind, facing);
        const Vector3<T> n = is_flat(kind) ? Vector3<T>(R_wb.col(1)) : normal;
        const T along = u.dot(n);
        return c.all_ways * all_ways + c.along * (speed + more * along * along) * (n * n.transpose());
    }
    Vector3<T> across = u;
    Matrix3<T> plane = Matrix3<T>::Identity();
    const Vector3<T> t = R_wb.col(2);
    across -= u.dot(t) * t;
    plane -= t * t.transpose();
    const T speed = across.norm();
    if (!(speed > 0)) return Matrix3<T>::Zero();
    return speed * plane + across * across.transpose() / speed;
}

// Returns how fast a plate's moment about its joint may change with its rotation, over kappa rho A and the distance of its centre of mass: [m^2/s^2],
// symmetric, positive semidefinite. The moment is -(1 - s) G |u| (u.n) x, x the width's axis, and changes by at most (1 - s) G |u|^2 a radian. The
// result is twice that: a plate held broadside to the wind, which turns at up to |u| over that distance and would spin round in a step, then turns by
// half a radian at most. The result is zero for all else, whose force does not turn with it, or whose wood is stiffer than this.
template <class T> Matrix3<T> air_turning(Kind kind, const Matrix3<T>& R_wb, const Vector3<T>& u) {
    if (!is_flat(kind)) return Matrix3<T>::Zero();
    const T most = T(1 - streaming_drag) * unfolded(kind, u.norm()) * u.squaredNorm();
    return 2 * most * (R_wb.col(0) * R_wb.col(0).transpose());
}

// [N m/rad] Returns how the drag of all that a body carries, its own included, resists the body's turning where the drag pulls outward. What hangs in
// a wind has a stiffness from drag as it has one from gravity, of the same form without its part below zero. P: first moment of kappa rho A [kg],
// world (CoupledPlan::carried_drag). u: the air's velocity past the body, taken as that past all it carries. folds: what it carries is foliage. The
// result is symmetric, positive semidefinite.
template <class T> Matrix3<T> streaming_stiffness(bool folds, const Vector3<T>& P, const Vector3<T>& u) {
    const T size = P.squaredNorm(), speed = u.norm();
    if (!(size > 0)) return Matrix3<T>::Zero();
    const T along = speed * unfolded(folds ? Kind::leaf : Kind::branch, speed) * std::max(P.dot(u), T(0));
    return along * (Matrix3<T>::Identity() - P * P.transpose() / size);
}

// [1/s] Returns the rate by which the air takes a blade's or a clump's own turning: the torque is minus this times I w. drag_area: kappa rho A.
template <class T> T spin_rate(Kind kind, T drag_area, T mass, const Vector3<T>& u) {
    if (!is_foliage(kind) || !(mass > 0)) return 0;
    const T speed = u.norm();
    return T(is_flat(kind) ? blade_turning : clump_turning) * drag_area / mass * unfolded(kind, speed) * speed;
}

} // namespace bough
