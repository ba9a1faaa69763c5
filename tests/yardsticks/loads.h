// loads.h: torques and forces on the bodies, written out of the definitions (design section 4, scene.h) a second time and
// without the library's own maps, so that a slip in either shows.
//
//   spring and damper   torque on the child in its body axes  -T^T K (theta + beta theta_dot), theta_dot = T rate
//   wind                kappa rho A |u_n| u_n (branch, A = l (r0 + r1), kappa 0.6), kappa rho A |u| u (fruit, pi r^2, 0.235),
//                       kappa rho A |u| (u.n) n (leaf, l w / 2, 0.6), u the wind less the centre's velocity; at the centre of mass
//   pull                a force on a point of a body
// Gravity is the engine's. The wind is that of scene.h without turbulence, and uniform over height.
#pragma once
#include "engine.h"
#include "lib/model/scene.h"

namespace yardstick {

// The rotation vector of a unit quaternion and T, theta_dot = T rate. From q = (cos a/2, n sin a/2).
Vec3 rotation_vector(const Quat& turn);
Mat3 rate_map(const Vec3& theta);
Quat turn_of(const Vec3& theta);

// A scene's pulls with their targets: body and point are given, the selector is not read.
struct Target {
    std::size_t body;
    Vec3 point_b; // [m] body frame
};

void compute_loads(const Tree&, const bough::Scene&, const std::vector<Target>&, double time, const Motion&,
                   const Bodies&, Loads&);

} // namespace yardstick
