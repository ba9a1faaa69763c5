#include "stiffness.h"
#include "body_shape.h"
#include "branch_mode.h"
#include <algorithm>
#include <numbers>

namespace bough {

using std::numbers::pi;

namespace {

constexpr double petiole_radius = 0.009; // blade lengths
constexpr double twig_share = 1.5e-4;    // wood's cross-section over the leaf area that it bears (Huber value)
constexpr double shoot_modulus = 3e9;    // [Pa]
constexpr double shoot_droop = 0.25;     // [rad] at most, held out level
constexpr double clump_damping_ratio = 0.2;
constexpr double stalk_radius = 0.04;      // fruit radii
constexpr double least_stalk_length = 0.5; // fruit radii
constexpr double twist_to_bend = 4.3;      // EI / GJ of petioles

Vec3 rod_stiffness(double modulus, double length, double radius) {
    const double bend = modulus * pi * radius * radius * radius * radius / (4 * length);
    return {bend, bend, bend / twist_to_bend};
}

double damping_ratio(const Material& material, const Tree& tree, std::size_t i) {
    if (is_clump(tree, i)) return clump_damping_ratio;
    if (is_foliage(tree.kind[i])) return material.leaf_damping_ratio;
    if (tree.kind[i] == Kind::fruit) return material.fruit_damping_ratio;
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
    const double l = petiole_share * length, blade = length - l, lever = blade / 2;
    const Vec3 rod = rod_stiffness(material.leaf_modulus, l, petiole_radius * blade);
    // A force at the blade's centre bends the rod by l^3/3 + l^2 lever + l lever^2 over E I; the joint at its foot by (l + lever)^2 over K.
    const double bend = l * (l + lever) * (l + lever) / (l * l * l / 3 + l * l * lever + l * lever * lever);
    return {bend * rod[0], bend * rod[1], rod[2]};
}

Vec3 clump_stiffness(const Material& material, const Vec3& size) {
    const double area = leaf_area(size[0], size[1]), r2 = twig_share * area / pi;
    const MassProperties body = leaf_clump(size[0], size[1], size[2], material.leaf_density);
    const double borne = body.mass * 9.81 * body.com.z() / shoot_droop;
    const double bend = std::max(4.39 * shoot_modulus * pi * r2 * r2 / 4 / size[0], borne);
    return {bend, bend, bend / 2};
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
        case Kind::clump:
        case Kind::tuft:
            body = (is_clump(tree, i)            ? leaf_clump
                    : tree.kind[i] == Kind::leaf ? leaf_blade
                                                 : leaf_prism)(size[0], size[1], size[2], material.leaf_density);
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
        case Kind::clump:
        case Kind::tuft:
            tree.stiffness[i] = is_clump(tree, i) ? clump_stiffness(material, size) : leaf_stiffness(material, size[0]);
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
        tree.damping[i] = omega > 0 ? 2 * damping_ratio(material, tree, i) / omega : 0;
    }
}

} // namespace bough
