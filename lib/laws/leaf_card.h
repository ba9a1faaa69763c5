// leaf_card.h: what the air does to a leaf or petal that flies as one rigid card (free/leaf_flight.h): (23) and (24), with /leaves or their defaults.
//
// u is the wind's velocity less the card's, n the card's normal (either way), u_n = (u.n) n, u_t = u - u_n, A its area; kappa, nu, xi, phi are
// LeafAir's:
//   force    kappa rho A |u| u_n + nu m (u_n + u_t / xi)
//   torque   k (u.n) n x (u cos phi + n x u sin phi) - nu I w,   k = kappa rho A/2 sqrt(A/pi)
// This differs from leaf_air.h: a card neither folds nor has the streaming part of air.h, its force is taken over its mass, and its step asks for
// other bounds. tests/lib/free/leaf_flight.cpp holds it against (23) and (24) written out.
#pragma once
#include "../model/scene.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bough {

// The body axes have x along the width, y along the normal and z along the length, as in body_shape.h. They are principal axes about the centre of
// mass.
struct LeafCard {
    double mass = 0;             // [kg] above 0
    Vec3 inertia = Vec3::Zero(); // [kg m^2] above 0
    double area = 0;             // [m^2] A_t
};

struct CardAir {
    double drag;          // [1/m] kappa rho A / m
    double across, along; // [1/s] nu, nu / xi
    double torque;        // [kg m^2 / m^2] k
    double cos_offset, sin_offset;
};

inline CardAir card_air(const LeafAir& air, const LeafCard& card, double air_density) {
    const double pressed = air.kappa * air_density * card.area, offset = air.offset * std::numbers::pi / 180;
    return {pressed / card.mass,
            air.air_resistance,
            air.air_resistance / air.drag_ratio,
            pressed / 2 * std::sqrt(card.area / std::numbers::pi),
            std::cos(offset),
            std::sin(offset)};
}

// [m/s^2] Returns the force over the mass, with gravity.
inline Vec3 card_acceleration(const CardAir& f, const Vec3& gravity, const Vec3& n, const Vec3& u) {
    const double along = u.dot(n);
    return gravity + along * (f.drag * u.norm() + f.across - f.along) * n + f.along * u;
}

// [N m] Returns the torque without nu I w.
inline Vec3 card_torque(const CardAir& f, const Vec3& n, const Vec3& u) {
    const Vec3 turning = n.cross(u);
    return f.torque * u.dot(n) * (f.cos_offset * turning + f.sin_offset * n.cross(turning));
}

// [1/s] Returns nu, the rate by which the air takes the card's turning.
inline double card_spin(const CardAir& f) {
    return f.across;
}

// [1/s] How fast the acceleration falls with the card's speed, along the normal and along the surface.
struct CardDamping {
    double normal, surface;
};
inline CardDamping card_damping(const CardAir& f, const Vec3& n, const Vec3& u) {
    const double speed = u.norm(), through = u.dot(n), falls = speed > 0 ? speed + through * through / speed : 0;
    return {f.across + f.drag * falls, f.along};
}

// [N m/rad] Returns the most that the torque changes by when the card turns about an axis of its surface, times h2.
inline double card_turning(const CardAir& f, double speed, double h2) {
    return h2 * f.torque * speed * speed;
}

// [1/s] Returns the rate of turning at `turning`, swinging and drag together. lightest: [kg m^2] the smaller moment of inertia about an axis of the
// surface.
inline double card_rates(const CardAir& f, double turning, double lightest, double speed) {
    return turning + (std::sqrt(f.torque / lightest) + 2 * f.drag) * speed + f.across;
}

} // namespace bough
