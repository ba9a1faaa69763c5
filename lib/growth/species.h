// species.h: a kind of tree: how it grows when mature, how it was smaller when young, and what it bears in which season.
#pragma once
#include "bark_form.h"
#include "growth_parameters.h"
#include "leaf_form.h"
#include <array>
#include <string>
#include <vector>

namespace bough {

enum class Season : std::uint8_t { spring, summer, autumn, winter };

struct Species {
    std::string name, source;
    std::string material;    // preset of wood.h
    GrowthParameters growth; // at mature_age, with all that it ever bears

    // Share of growth's leaves, blossoms and fruit in spring, summer, autumn and winter, 0..1.
    std::vector<double> season_leaves = {1, 1, 1, 0};
    std::vector<double> season_petals = {1, 0, 0, 0};
    std::vector<double> season_fruit = {0, 1, 1, 0};
    std::vector<Vec3> color;             // as Splines::color; empty or 4
    LeafForm leaf;                       // how its leaves look
    BarkForm bark;                       // and its bark
    std::vector<Vec3> season_leaf_color; // sRGB of leaves in the four seasons; empty: color's in all

    // Height over that of a tree without end follows Chapman and Richards, (1 - e^(-height_rate age))^height_power.
    double mature_age = 60;      // [years] > 0
    double height_rate = 0.04;   // [1/years] > 0
    double height_power = 1.3;   // > 0
    double diameter_power = 1.5; // 0..4; diameter goes with height to this power (1.5: elastic similarity)
    double branches_power = 1;   // 0..4; so do each stem's numbers of children (1: a constant distance)
};

// "broadleaf": default_growth(), of the default wood.
Species default_species();

// The growth of a tree of this age [years]: the mature one's with height times f, the ratio of the two heights, the
// trunk's radius times f^diameter_power, numbers of children times f^branches_power. A level that would come to less than
// one stem a parent is left out. O(1). Throws std::invalid_argument unless age is finite, and 0.1 or more.
GrowthParameters at_age(const Species&, double age);

// What this season leaves of growth's leaves, blossoms and fruit, and its colours.
GrowthParameters in_season(const Species&, const GrowthParameters&, Season);
std::vector<Vec3> colors_in_season(const Species&, Season);

// Throws std::invalid_argument for the first value out of its range, as check_growth does.
void check_species(const Species&);

} // namespace bough
