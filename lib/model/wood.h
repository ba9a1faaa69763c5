// wood.h: what a tree is made of: presets with sources, or the user's own file (formats/documents/material.h).
#pragma once
#include "splines.h"
#include <optional>
#include <string>
#include <vector>

namespace bough {

struct Material {
    std::string name;               // preset name or file
    double density = 0;             // [kg/m^3] green wood, with its water: what moves
    double youngs_modulus = 0;      // [Pa] E along the grain, green
    double shear_modulus = 0;       // [Pa] G for torsion about the grain (about E/15 in wood)
    double damping_ratio = 0;       // [1] zeta of the branch's first bending mode, structural (no air)
    double strength = 0;            // [Pa] bending stress at which green wood breaks (modulus of rupture)
    double leaf_density = 0;        // [kg/m^3] of fresh leaf tissue
    double leaf_thickness = 0;      // [m]
    double petal_thickness = 0;     // [m]; all else of a petal is a leaf's
    double leaf_modulus = 0;        // [Pa] E of the petiole, which is what a leaf bends on, and of the fruit's stalk
    double leaf_damping_ratio = 0;  // [1] of the leaf on its petiole
    double fruit_density = 0;       // [kg/m^3]
    double fruit_damping_ratio = 0; // [1]
    std::string source;             // where the figures are from
};

// Returns all presets, each with its source; the first is the default. --help lists the names in this order.
const std::vector<Material>& wood_presets();
// Returns the preset of this name, or nullptr.
const Material* find_wood(const std::string& name);

// Returns the first broken rule, or none. All values must be finite; density, moduli and thickness above 0, damping ratios 0 or more.
std::optional<Defect> check(const Material&);

} // namespace bough
