#include "body_shape.h"
#include <numbers>

namespace bough {

using std::numbers::pi;

// With a, b the radii at base and tip and z from the base:
//   volume             pi l / 3  (a^2 + a b + b^2)
//   centre of mass     l / 4     (a^2 + 2 a b + 3 b^2) / (a^2 + a b + b^2)
//   about z            pi l / 10 (a^4 + a^3 b + a^2 b^2 + a b^3 + b^4)
//   across, about com  half of that + pi l^3 / 80 (a^4 + 4 a^3 b + 10 a^2 b^2 + 4 a b^3 + b^4) / (a^2 + a b + b^2)
// all sums of positive terms: nothing cancels however near the radii are.
MassProperties frustum(double length, double radius_base, double radius_tip, double density) {
    const double a = radius_base, b = radius_tip;
    const double squares = a * a + a * b + b * b;
    MassProperties body;
    body.com.z() = length / 2;
    if (!(squares > 0)) return body;
    body.mass = density * pi * length / 3 * squares;
    body.com.z() = length / 4 * (a * a + 2 * a * b + 3 * b * b) / squares;
    const double about = density * pi * length / 10 * (a * a * (a * a + a * b + b * b) + b * b * b * (a + b));
    const double spread = a * a * a * (a + 4 * b) + 10 * a * a * b * b + b * b * b * (4 * a + b);
    const double across = about / 2 + density * pi * length * length * length / 80 * spread / squares;
    body.inertia = Vec3(across, across, about).asDiagonal();
    return body;
}

MassProperties leaf_prism(double length, double width, double thickness, double density) {
    MassProperties body;
    body.mass = density * leaf_area(length, width) * thickness;
    body.com.z() = length / 3;
    const double x2 = width * width / 24, y2 = thickness * thickness / 12, z2 = length * length / 18;
    body.inertia = (body.mass * Vec3(y2 + z2, x2 + z2, x2 + y2)).asDiagonal();
    return body;
}

MassProperties leaf_blade(double length, double width, double thickness, double density) {
    MassProperties body;
    body.mass = density * leaf_area(length, width) * thickness;
    const double blade = (1 - petiole_share) * length;
    body.com.z() = length - blade / 2;
    const double x2 = width * width / 16, y2 = thickness * thickness / 12, z2 = blade * blade / 16;
    body.inertia = (body.mass * Vec3(y2 + z2, x2 + z2, x2 + y2)).asDiagonal();
    return body;
}

MassProperties leaf_clump(double length, double width, double thickness, double density) {
    MassProperties body;
    body.mass = density * leaf_area(length, width) * thickness;
    body.com.z() = length / 2;
    const double x2 = width * width / 20, y2 = clump_depth * clump_depth * x2, z2 = length * length / 20;
    body.inertia = (body.mass * Vec3(y2 + z2, x2 + z2, x2 + y2)).asDiagonal();
    return body;
}

MassProperties sphere(double center, double radius, double density) {
    MassProperties body;
    body.mass = density * 4 * pi / 3 * radius * radius * radius;
    body.com.z() = center;
    body.inertia = Mat3::Identity() * (0.4 * body.mass * radius * radius);
    return body;
}

double frustum_section(double length, double radius_base, double radius_tip) {
    return length * (radius_base + radius_tip);
}

double leaf_area(double length, double width) {
    return length * width / 2;
}

double sphere_section(double radius) {
    return pi * radius * radius;
}

} // namespace bough
