// resolve_sums.h: what the parts of each resolved body come to together (resolve.h). Private to resolve.
#pragma once
#include "../model/air_constants.h"
#include "resolve_choice.h"

namespace bough {

// What the parts of a resolved body come to, about its joint, in the world's axes.
struct Sums {
    double mass = 0, give = 0, loss = 0;
    double damping = 0;  // [s] the most of its joints
    bool upright = true; // all of them stand, with all that they carry
    // Of its bend where it is held and pushed by 1 m/s^2 along each axis, summed: twice the kinetic energy at 1 rad/s [kg s^4]; the area of
    // leaves that face all ways, times its way squared, that damps as much [m^2 s^4].
    double swing = 0, braked = 0;
    Vec3 first = Vec3::Zero(); // [kg m] about the world's origin
    double leaves = 0;         // [m^2]
    Mat3 faces = Mat3::Zero(); // [m^2] n n^T of leaves by their area, n their normals, wood as leaves across it
    double met = 0;            // [m^2] of leaves that face all ways, of the same drag in horizontal winds
    double wood = 0; // [m^2] of wood across the wind, of the same drag as its wood and fruit in horizontal winds
    Vec3 air = Vec3::Zero();    // [m^3] places of leaves, wood and fruit, times their area as leaves that face all ways
    double thickness = 0;       // [m] times the leaves' area
    double proportion = 0;      // [1] likewise
    std::int64_t count = 0;     // leaves
    Vec3 joints = Vec3::Zero(); // [kg m] of what hangs directly on the wood, by its mass
    double joined = 0;          // [kg]
    std::int32_t parts = 0;
    Mat3 yields = Mat3::Zero();  // [rad/(N m)] the joints of its own branch to a torque about the first of them, world
    std::int32_t last = -1;      // the last piece of its branch
    Mat3 inertia = Mat3::Zero(); // about the centre of mass, world
    Vec3 com = Vec3::Zero();     // [m] world
};

// Of each resolved body. O(bodies).
std::vector<Sums> sum_up(const Tree& whole, const Flexibility&, const Resolution&);

// How the air sees several of the tree's leaves, by the mean of their proportions.
Kind kind_of_many_leaves(const Tree&);

// A twig's drag in that of many leaves that face all ways, of the same area (air.h): twice as much broadside, and leaves fold and turn with the
// wind, which is made up for at 8 m/s. (So a clump's wood has half as much drag again at 5 m/s, and half of it at 20.)
double wood_in_leaf(Kind many);

// A cylinder's drag over that of one across the wind, mean over horizontal winds.
double met_by_wind_across(const Vec3& axis);

// [1] The drag of leaves that face along n by `facing` (Tree::leaf_facing; a blade by 1), over that of as many that face all ways: mean over
// horizontal winds.
double met_by_wind(const Vec3& n, double facing);

// How the air damps the motion of such leaves, in units of the next.
Mat3 damped(Kind many, const Vec3& n, double facing);

// How the air damps the motion of many leaves that face all ways, over G |u| of air.h: mean over horizontal winds of 8 m/s.
Mat3 damped_all_ways(Kind many);

// Likewise of wood along t, over |u| of one across the wind.
Mat3 damped_wood(const Vec3& t);

} // namespace bough
