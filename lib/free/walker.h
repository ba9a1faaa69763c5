// walker.h: a weight that runs along branches, leaps and lands (§10, figure 15).
//
// Way. A walker goes from stop to stop of the same wood along the bodies' axes, through the body that carries both. After the part x of the time it
// has gone the part x^3 (10 - 15 x + 6 x^2) of the way, so that it starts and ends at rest. To another tree or another trunk, or where the stop says
// so, it leaps. It is pushed off for `push` seconds, flies on a parabola, and is caught for `push` seconds; its velocity rises and falls by x - sin(2
// pi x) / 2 pi. At two stops at one place it waits. At its first stop it sets its weight (g below) down over `push` seconds. After its last stop it
// stays.
// Force. The branch gives it all of its momentum except gravity's. In a step of length h from t, with its velocity V on the drawn trees, the force
//   F = m (g - (V(t + h) - V(t)) / h)
// acts on the body that it is on at the middle of the step. If it is then in the air, the force acts on the nearer end of the leap; in the air F is 0
// of itself. Over a walk from rest to rest the sum of F h is exactly m g times its time, leaps and corners included.
// What is left out: the branch's own motion is not part of V, so the weight does not swing with the branch as a mass would, and a moved root carries
// nothing into V.
// Reads   the joined tree as drawn, gravity. Cost O(bodies on the way) once, O(stops) a step. Errors: std::out_of_range with the stop's pointer for a
// selector that names no body or many, and for a leap that has no time to fly.
#pragma once
#include "../model/scene.h"

namespace bough {

// A straight piece of the way on one body.
struct WalkPiece {
    std::size_t body;
    Vec3 from_b, to_b; // [m] body frame
    Vec3 along;        // unit vector, world, drawn
    double at;         // [m] of the way before it
};

struct WalkLeg {
    double start, end; // [s]
    bool leap;
    std::vector<WalkPiece> pieces; // in order, at least one; of a leap two: where it leaves and where it lands
    double length = 0;             // [m]
    Vec3 leave = Vec3::Zero(), land = Vec3::Zero(); // [m/s] of a leap
};

struct Walk {
    double mass = 0, radius = 0, push = 0;
    Vec3 gravity = Vec3::Zero();
    std::vector<WalkLeg> legs; // one after the other in time
};

Walk make_walk(const Tree& joined, const std::vector<TreeRange>&, const Walker&, const Vec3& gravity,
               const std::string& at);

struct WalkerLoad {
    std::size_t body;
    Vec3 point_b; // [m] body frame
    Vec3 force;   // [N] world
};
// Returns the force in the step from t to t + h; none before the first stop and in the air.
std::optional<WalkerLoad> walker_load(const Walk&, double t, double h);

// Where it is at time t: on a body, or in the air between two.
struct WalkerPlace {
    std::size_t body, next;  // the same but in the air
    Vec3 point_b, next_b;    // [m]
    double part = 0;         // of the flight that is behind
    Vec3 bow = Vec3::Zero(); // [m] that it is beside the straight line between the two
};
WalkerPlace walker_place(const Walk&, double t);

Vec3 walker_velocity(const Walk&, double t); // [m/s] on the drawn trees

} // namespace bough
