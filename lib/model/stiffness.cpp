#include "stiffness.h"
#include "body_shape.h"
#include "branch_mode.h"
#include <algorithm>
#include <numbers>

namespace bough {

using std::numbers::pi;

namespace {

constexpr double petiole_length = 0.5;     // blade lengths
constexpr double petiole_radius = 0.0075;  // blade lengths
constexpr double stalk_radius = 0.04;      // fruit radii
constexpr double least_stalk_length = 0.5; // fruit radii
constexpr double twist_to_bend = 4.3;      // EI / GJ of petioles

Vec3 rod_stiffness(double modulus, double length, double radius) {
    const double bend = modulus * pi * radius * radius * radius * radius / (4 * length);
    return {bend, bend, bend / twist_to_bend};
}

double damping_ratio(const Material& material, Kind kind) {
    switch (kind) {
    case Kind::leaf:
    case Kind::petal:
        return material.leaf_damping_ratio;
    case Kind::fruit:
        return material.fruit_damping_ratio;
    case Kind::branch:
        break;
    }
    return material.damping_ratio;
}

} // namespace

double integral_r4(double length, double a, double b) {
    return length * (a * a + a * b + b * b) / (3 * a * a * a * b * b * b);
}

Vec3 branch_stiffness(const Material& material, const Vec3& piece, const Vec3* parent) {
    const auto middle = [](const Vec3& size) { return (size[1] + size[2]) / 2; };
    double r4 = integral_r4(piece[0] / 2, piece[1], middle(piece));
    if (parent) r4 += integral_r4((*parent)[0] / 2, middle(*parent), (*parent)[2]);
    const double bend = material.youngs_modulus * pi / 4 / r4;
    return {bend, bend, material.shear_modulus * pi / 2 / r4};
}

Vec3 leaf_stiffness(const Material& material, double length) {
    return rod_stiffness(material.leaf_modulus, petiole_length * length, petiole_radius * length);
}

Vec3 fruit_stiffness(const Material& material, double joint_to_center, double radius) {
    const double length = std::max(joint_to_center - radius, least_stalk_length * radius);
    return rod_stiffness(material.leaf_modulus, length, stalk_radius * radius);
}

void set_mass(Tree& tree, const Material& material) {
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3& size = tree.size[i];
        MassProperties body;
        switch (tree.kind[i]) {
        case Kind::branch:
            body = frustum(size[0], size[1], size[2], material.density);
            break;
        case Kind::leaf:
        case Kind::petal:
            body = leaf_prism(size[0], size[1], size[2], material.leaf_density);
            break;
        case Kind::fruit:
            body = sphere(size[0], size[1], material.fruit_density);
            break;
        }
        tree.mass[i] = body.mass;
        tree.com[i] = body.com;
        tree.inertia[i] = body.inertia;
    }
}

void set_stiffness(Tree& tree, const Material& material) {
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3& size = tree.size[i];
        switch (tree.kind[i]) {
        case Kind::branch:
            tree.stiffness[i] = branch_stiffness(
                material, size, continues_parent(tree, i) ? &tree.size[std::size_t(tree.parent[i])] : nullptr);
            break;
        case Kind::leaf:
        case Kind::petal:
            tree.stiffness[i] = leaf_stiffness(material, size[0]);
            break;
        case Kind::fruit:
            tree.stiffness[i] = fruit_stiffness(material, size[0], size[1]);
            break;
        }
    }
}

void set_damping(Tree& tree, const Material& material) {
    const BranchModes modes = branch_modes(tree);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const double omega = modes.omega_bend[i];
        tree.damping[i] = omega > 0 ? 2 * damping_ratio(material, tree.kind[i]) / omega : 0;
    }
}

} // namespace bough
