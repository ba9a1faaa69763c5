// pick.h: which body a ray meets: what a hand on a screen points at.
//
//   Ray from the eye through the pointer; aperture = atan(15 / (pixels / 2) * tan(angle of view / 2)) for a finger of 15 pixels' radius
//   if (auto hit = pick(simulation, ray)) simulation.pull(hit->body, hit->point, force);
//
// The first body that the ray itself meets is picked. If it meets none and the aperture is above 0, the body whose axis is least off the ray is
// picked, if within the aperture: a twig of a millimetre is no wider than a pixel. The ray meets branches as frustums with their ends, fruit as
// spheres without their stalks, leaves and petals as the flat kites that skin.h draws, and clumps of leaves as ellipsoids. It does not meet balls and
// walkers.
#pragma once
#include "simulation.h"
#include <optional>

namespace bough {

struct Ray {
    Vec3 from = Vec3::Zero();      // [m] world
    Vec3 direction = Vec3::Zero(); // world, of any length but 0
    double aperture = 0;           // [rad] 0 to pi / 2: half the angle of the cone in which a body near the ray will do
};

struct RayHit {
    std::size_t body; // in document order, of the trees
    Vec3 point;       // [m] body frame, as Simulation::pull takes it: on the surface; near the ray, on the axis
    Vec3 world;       // [m] the same
    double distance;  // [m] from the ray's start
};

// Picks in the present state. O(bodies), of which most cost a few multiplications. Throws SceneError for an invalid ray.
std::optional<RayHit> pick(const Simulation&, const Ray&);
// The same for a tree's bodies at these poses: positions of their own joints and rotations world from body, at least one for each body.
std::optional<RayHit> pick(const Tree&, std::span<const Vec3> positions, std::span<const Quat> rotations, const Ray&);

} // namespace bough
