#include "material_change.h"
#include "branch_mode.h"
#include "check_parts.h"
#include "root_stiffness.h"
#include "wood.h"
#include <cmath>
#include <stdexcept>

namespace bough {
namespace {

const Material& own_material(const Tree& tree) {
    if (const Material* own = find_wood(tree.material)) return *own;
    std::string names;
    for (const Material& m : wood_presets()) names += (names.empty() ? "" : ", ") + m.name;
    const std::string is = tree.material.empty() ? "is not named" : "is \"" + tree.material + "\"";
    throw std::domain_error(is + ", so that its numbers are not known and cannot be changed; expected one of " + names);
}

void change_wood(Tree& tree, const MaterialChange& change) {
    const Material& own = own_material(tree);
    const double bend = change.youngs_modulus.value_or(own.youngs_modulus) / own.youngs_modulus;
    const double twist = change.shear_modulus ? *change.shear_modulus / own.shear_modulus : bend;
    const double heavier = change.density.value_or(own.density) / own.density;
    const double damped = change.damping_ratio.value_or(own.damping_ratio) / own.damping_ratio;
    const bool frequencies = bend != 1 || heavier != 1;
    std::vector<double> before, after;
    if (frequencies) before = branch_modes(tree).omega_bend;
    const std::size_t n = tree.size_bodies();
    for (std::size_t i = 0; i < n; ++i) {
        if (tree.kind[i] != Kind::branch) continue;
        tree.stiffness[i] = tree.stiffness[i].cwiseProduct(Vec3(bend, bend, twist));
        tree.mass[i] *= heavier;
        tree.inertia[i] *= heavier;
    }
    if (frequencies) after = branch_modes(tree).omega_bend;
    for (std::size_t i = 0; i < n; ++i) {
        if (tree.kind[i] != Kind::branch) continue;
        tree.damping[i] *= damped;
        if (frequencies && after[i] > 0) tree.damping[i] *= before[i] / after[i];
    }
    tree.material += " (changed)";
}

} // namespace

std::optional<Defect> check(const MaterialChange& change) {
    for (const auto& [field, value] : {std::pair{"material/E", change.youngs_modulus},
                                       {"material/G", change.shear_modulus},
                                       {"material/density", change.density},
                                       {"material/root_stiffness", change.root_stiffness}})
        if (value)
            if (auto defect = above_zero(field, *value)) return defect;
    if (change.damping_ratio) return at_least("material/damping_ratio", *change.damping_ratio, 0);
    return std::nullopt;
}

void change_material(Tree& tree, const MaterialChange& change) {
    if (change.wood()) change_wood(tree, change);
    if (change.root_stiffness) stand_on_springs(tree, *change.root_stiffness);
}

} // namespace bough
