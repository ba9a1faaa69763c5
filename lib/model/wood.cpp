#include "wood.h"
#include <algorithm>
#include <cmath>

namespace bough {

namespace {

// Green density from basic density (oven-dry mass over green volume, in units of water's): cell walls weigh 1530 kg/m^3,
// and 60 % of the space they leave is water, as in living sapwood. Gives 800 to 970 kg/m^3 for the species below. The Wood Handbook's table of green
// woods (FPL-GTR-282, table 4-1: water over dry wood, heartwood / sapwood) has apple 81 / 74 %, paper birch 89 / 72 and black cherry 58 / -: by the
// mean of both the rule is 10 % light for apple and 3 % heavy for birch, and 7 % heavy for cherry's heartwood. Quaking aspen and Douglas-fir, 14 and
// 10 % heavy by it, have the table's own water instead (with_water).
double green_density(double basic) {
    return 1000 * (basic + 0.6 * (1 - basic / 1.53));
}

constexpr double needle = 0.6e-3; // [m] as thick as it is wide

// Seen in print for this: sugar maple (0.56, 10.7 GPa, 65 MPa), black willow (0.36, 0.79e6 psi, 4 800 psi; also Alden, Hardwoods of North America,
// FPL-GTR-83), and the basic densities of red maple, black cherry and red oak. The others' figures have not been looked up again.
const char* const handbook =
    "basic density and E green: USDA Forest Service, Wood Handbook (FPL-GTR-282), table 5-3, and so the modulus of "
    "rupture, green; density with water: 60 % of the space left by cell walls filled; "
    "G = E/15; damping, leaf and fruit figures: typical orders of magnitude";

// strength_mpa: green modulus of rupture.
Material wood(const char* name, double basic, double youngs_gpa, double strength_mpa, const char* source = handbook,
              double leaf_thickness = 0.25e-3) {
    Material m;
    m.name = name;
    m.density = std::round(green_density(basic));
    m.youngs_modulus = youngs_gpa * 1e9;
    m.shear_modulus = m.youngs_modulus / 15;
    m.strength = strength_mpa * 1e6;
    m.damping_ratio = 0.03; // within the wood, without leaves or air: Moore & Maguire (2004) found less than 0.05
    m.leaf_density = 800;
    m.leaf_thickness = leaf_thickness;
    m.petal_thickness = 0.15e-3;
    m.leaf_modulus = 0.5e9;
    m.leaf_damping_ratio = 0.05;
    m.fruit_density = 850;
    m.fruit_damping_ratio = 0.05;
    m.source = source;
    return m;
}

// water: over the dry wood, as the table of green woods has it.
Material with_water(Material m, double basic, double water, const char* source) {
    m.density = std::round(1000 * basic * (1 + water));
    m.source = source;
    return m;
}

const char* const handbook_water =
    "basic density and E green: USDA Forest Service, Wood Handbook (FPL-GTR-282), table 5-3, and so the modulus of "
    "rupture, green; density with water: the mean of heartwood's and sapwood's of table 4-1; "
    "G = E/15; damping, leaf and fruit figures: typical orders of magnitude";

// A living ash is drier than other broadleaved trees: 46 and 44 % in white ash's heartwood and sapwood (table 4-1).
Material european_ash() {
    return with_water(wood("european-ash", 0.55, 9.5, 66), 0.55, 0.45,
                      "E and modulus of rupture green: Lavers, The strength properties of timber (1983), Fraxinus "
                      "excelsior, as Jackson et al. (2019) have them; "
                      "density: basic 0.55 with water of 45 % of the dry wood, as white ash's in the USDA Wood "
                      "Handbook's table 4-1; G = E/15; damping, leaf and fruit figures: typical orders of magnitude");
}

struct Range {
    const char* field;
    double value;
    bool zero_allowed;
};

} // namespace

const std::vector<Material>& wood_presets() {
    static const std::vector<Material> presets = {
        wood("red-maple", 0.49, 9.6, 53),
        wood("sugar-maple", 0.56, 10.7, 65),
        wood("black-cherry", 0.47, 9.0, 55),
        wood("black-willow", 0.36, 5.4, 33),
        with_water(wood("quaking-aspen", 0.35, 5.9, 35), 0.35, 1.04, handbook_water), // 95 and 113 %
        wood("paper-birch", 0.48, 8.1, 44),
        wood("northern-red-oak", 0.56, 9.3, 57),
        wood("apple", 0.61, 7.4, 51,
             "basic density 0.61, E dry 8.76 GPa: common wood tables; E green taken as 0.85 of it, as in cherry and "
             "maple; modulus of rupture 88 MPa dry, 0.58 of it green, as in these; the rest as the other presets: 60 % "
             "of the space left by cell walls filled with water; G = E/15; "
             "damping, leaf and fruit figures: typical orders of magnitude"),
        with_water(wood("douglas-fir", 0.45, 10.8, 53, handbook, needle), 0.45, 0.76,
                   handbook_water), // 37 and 115 %, coast
        wood("eastern-white-pine", 0.34, 6.8, 34, handbook, needle),
        wood("loblolly-pine", 0.47, 9.7, 50, handbook, needle),
        wood(
            "coconut-palm", 0.50, 6.0, 38,
            "basic density 0.5, E 6 GPa: the stem as a whole, denser and stiffer at its rim (0.6 and 8 to 11 GPa) than "
            "in its middle; modulus of rupture in proportion to E, after 45.1 MPa and 7.2 GPa of its green timber "
            "(Kerala Agricultural University, Timbers of Kerala: 460 and 73 400 kg/cm2); the rest as the other "
            "presets: 60 % of the space left by cell walls filled with water; "
            "G = E/15; damping, leaf and fruit figures: typical orders of magnitude",
            0.4e-3),
        european_ash(),
    };
    return presets;
}

const Material* find_wood(const std::string& name) {
    const auto& presets = wood_presets();
    const auto found = std::find_if(presets.begin(), presets.end(), [&](const Material& m) { return m.name == name; });
    return found == presets.end() ? nullptr : &*found;
}

std::optional<Defect> check(const Material& m) {
    const Range ranges[] = {
        {"density", m.density, false},
        {"youngs_modulus", m.youngs_modulus, false},
        {"shear_modulus", m.shear_modulus, false},
        {"damping_ratio", m.damping_ratio, true},
        {"strength", m.strength, false},
        {"leaf_density", m.leaf_density, false},
        {"leaf_thickness", m.leaf_thickness, false},
        {"petal_thickness", m.petal_thickness, false},
        {"leaf_modulus", m.leaf_modulus, false},
        {"leaf_damping_ratio", m.leaf_damping_ratio, true},
        {"fruit_density", m.fruit_density, false},
        {"fruit_damping_ratio", m.fruit_damping_ratio, true},
    };
    for (const Range& r : ranges)
        if (!std::isfinite(r.value) || r.value < 0 || (r.value == 0 && !r.zero_allowed))
            return Defect{r.field, -1,
                          r.zero_allowed ? "is not a finite number of 0 or more" : "is not a finite number above 0"};
    return std::nullopt;
}

} // namespace bough
