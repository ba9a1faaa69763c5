// body_shape.h: mass, centre of mass, inertia and areas of the body shapes (§3, §7, §8), in closed form.
//
// The body frame has its origin at the joint and z along the body.
//   frustum  its axis lies on z from 0 to length
//   petal    a thin uniform triangular prism: base edge (width) along x, centred on the origin; apex at z = length; thickness along y
//   leaf     the same mass and area, as an elliptic blade on a petiole without mass
//   clump    several leaves (tree.h) as an ellipsoid of their mass
//   fruit    a sphere with its centre on z
// Each result is exact for the solid named. O(1). Errors none: whoever made the sizes checks them (zero length or radius gives zero mass).
#pragma once
#include "../base/math.h"

namespace bough {

struct MassProperties {
    double mass = 0;             // [kg]
    Vec3 com = Vec3::Zero();     // [m] body frame
    Mat3 inertia = Mat3::Zero(); // [kg m^2] about com, body axes
};

MassProperties frustum(double length, double radius_base, double radius_tip, double density);
MassProperties leaf_prism(double length, double width, double thickness, double density);
// A leaf: an elliptic blade of two thirds of the length on a petiole of a third, with the triangle's area and mass.
MassProperties leaf_blade(double length, double width, double thickness, double density);
// A clump of leaves: their mass, spread evenly through an ellipsoid of that length and width, clump_depth times the width deep.
MassProperties leaf_clump(double length, double width, double thickness, double density);
constexpr double petiole_share = 1.0 / 3, clump_depth = 0.6;
MassProperties sphere(double center, double radius, double density);

// Longitudinal cross-section A_c of a frustum [m^2] (21): the trapezoid length * (radius_base + radius_tip).
double frustum_section(double length, double radius_base, double radius_tip);
// Area A_t of the leaf's triangle [m^2] (23).
double leaf_area(double length, double width);
// Circular cross-section A_s of a fruit [m^2] (22).
double sphere_section(double radius);

} // namespace bough
