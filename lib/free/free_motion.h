// free_motion.h: where a body that no joint holds is, and how it moves. It is in double, whatever the trees are in, since there are few such bodies.
#pragma once
#include "../base/math.h"

namespace bough {

struct FreeMotion {
    Vec3 x = Vec3::Zero();     // [m] centre of mass, world
    Quat q = Quat::Identity(); // world from body
    Vec3 v = Vec3::Zero();     // [m/s] of the centre of mass, world
    Vec3 omega = Vec3::Zero(); // [rad/s] world
};

} // namespace bough
