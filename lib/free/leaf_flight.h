// leaf_flight.h: how a leaf or petal flies that nothing holds: one rigid card in the air, forces (23) and (24).
//
// With the force f and the torque t of laws/leaf_card.h:   m v' = m g + f,   I w' + w x I w = t
// The torque turns the card broadside to the air (phi = 0: it has the potential -k (u.n)^2 / 2), and the card swings past that: to and fro, over and
// over, or, turned about the normal by phi, round and round. k |u_t|^2 / 2 goes into the swing without being taken from the fall. In still air
// without gravity (phi = 0), m v^2/2 + w.I w/2 + k |v_t|^2/2 never grows. Only nu stops a slow spin about the normal.
//
// A card is light: its speed in a wind settles within milliseconds, and it swings at sqrt(k/I) |u|, a radian in 1/30 s where it falls at 1 m/s. So
// the step is made in up to 16 parts, as many as keep a part's rates (turning, swing, drag, together) times its length at 1 at most. Such a part is
// Runge's of fourth order, and a fall at 1/30 s equals that at 1/3000 s until chaos parts them. Where 16 are too few (a card of a milligram in a
// storm, a step of a second) parts are longer and linearly implicit, with terms that hold at any length:
//   drag         (1 + h (nu + kappa rho A/m (|u| + (u.n)^2/|u|))) on the normal's part of the change, (1 + h nu/xi) on the rest
//   torque       (I (1 + h nu) + h^2 k |u|^2 (1 - n n^T)) w_1 = I w + h torque(0): |u|^2 bounds what the torque changes by a radian, so that it
//                turns the card by half a radian at the most
//   w x I w      from w at the start, then shortened to the energy that w had
// Both have the true terminal velocities as their fixed points: broadside m g = kappa rho A v^2 + nu m v.
// Cost    O(1): at most 16 parts of 0.3 us; a leaf of 5 cm that tumbles takes six. Errors none; non-finite in, non-finite out.
#pragma once
#include "../laws/leaf_card.h"
#include "free_motion.h"

namespace bough {

// Advances the card by h [s] in a wind [m/s] and gravity [m/s^2] that do not change on the way; air_density [kg/m^3].
void fly_leaf(const LeafAir&, const LeafCard&, const Vec3& wind, const Vec3& gravity, double air_density, double h,
              FreeMotion&);

} // namespace bough
