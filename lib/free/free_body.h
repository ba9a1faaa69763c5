// free_body.h: a body that no joint holds: a ball, or what broke off a tree, as one rigid body of the tree's bodies as they stood.
#pragma once
#include "../model/tree.h"
#include "free_motion.h"
#include "shape.h"

namespace bough {

struct Ball; // model/scene.h

// One of the bodies that it is made of, in the axes of the whole, about its centre of mass.
struct FreePart {
    std::int64_t body = -1;    // of the tree; -1: a ball
    Kind kind = Kind::fruit;   // its shape, as in Tree
    Vec3 size = Vec3::Zero();  // ... as in Tree
    Quat q = Quat::Identity(); // the whole's axes from the body's frame
    Vec3 joint = Vec3::Zero(); // [m] the body's joint
    Vec3 com = Vec3::Zero();   // [m] its centre of mass
    double drag_area = 0;      // [kg/m] kappa rho A (air.h)
};

struct FreeBody {
    FreeMotion motion;
    double mass = 0; // [kg]
    Mat3 inertia = Mat3::Zero(),
         inverse_inertia = Mat3::Zero(); // [kg m^2] about the centre of mass, own axes; and its inverse
    Mat3 axes = Mat3::Identity();        // principal axes in columns, own axes; a rotation
    Vec3 moments = Vec3::Zero();         // [kg m^2] about them, rising
    double bound = 0;                    // [m] farthest point from the centre of mass
    std::vector<FreePart> parts;
    bool at_rest = false; // it lies where it is from here on
    double quiet = 0;     // [s] for how long it has been slow on the ground

    bool ball() const { return parts.front().body < 0; }
    bool leaf() const { return parts.size() == 1 && is_flat(parts.front().kind); }
    Mat3 inverse_inertia_w() const {
        const Mat3 R = motion.q.toRotationMatrix();
        return R * inverse_inertia * R.transpose();
    }
    Vec3 velocity_at(const Vec3& arm) const {
        return motion.v + motion.omega.cross(arm);
    } // arm from the centre of mass, world
};

// [m] Returns the capsule, in the world, of a part of a body with this motion.
Capsule placed(const FreeMotion&, const FreePart&);

// Sets inverse_inertia, axes, moments and bound from inertia and parts. A body without extent about some axis gets four roundings of the trace there.
void finish(FreeBody&);

// Returns the scene's ball, in free air. drag_area is from air_density and C_d = 0.47.
FreeBody free_ball(const Ball&, double air_density);

} // namespace bough
