// material_change.h: gives a tree's wood other numbers than those of the material it was made of (Tree::material, a preset of wood.h). The result is
// what stiffness.h would have given with them, without the splines.
//
//   bend of branches   times E / E_0        twist   times G / G_0, G = G_0 E / E_0 unless given
//   mass, inertia of branches   times density / density_0
//   damping of branches   times (zeta / zeta_0) (omega_0 / omega), omega the first bending frequency of the joint's branch (branch_mode.h)
//                         before and after: it keeps its ratio, so that wood four times as stiff has half the beta
// Leaves, petals and fruit stay as they are, and so do clumps with the wood in them (growth/resolve.h). What was edited in a tree keeps its
// proportion. Tree::material then says that the wood is changed, so that a saved tree is not taken for the preset's. O(bodies).
#pragma once
#include "tree.h"
#include <optional>

namespace bough {

struct MaterialChange {
    std::optional<double> youngs_modulus; // [Pa] E; each absent: the material's own
    std::optional<double> shear_modulus;  // [Pa] G
    std::optional<double> density;        // [kg/m^3]
    std::optional<double> damping_ratio;  // [1]
    // [N m/rad] of a spring between the ground and each trunk (root_stiffness.h), after the others
    std::optional<double> root_stiffness;

    bool wood() const { return youngs_modulus || shear_modulus || density || damping_ratio; }
    bool any() const { return wood() || root_stiffness; }
};

// Returns the first broken rule, or none. All values must be finite and above 0, the damping ratio 0 or more.
std::optional<Defect> check(const MaterialChange&);

// Throws std::domain_error if wood is to change and the tree names no preset, since its present wood is then unknown.
void change_material(Tree&, const MaterialChange&);

} // namespace bough
