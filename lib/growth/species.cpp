#include "species.h"
#include "../base/shortest_text.h"
#include "grow.h"
#include "weber_penn.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bough {

namespace {

double relative_height(const Species& s, double age) {
    const auto grown = [&s](double years) { return std::pow(-std::expm1(-s.height_rate * years), s.height_power); };
    return grown(age) / grown(s.mature_age);
}

void require(bool holds, const std::string& field, const std::string& expected) {
    if (!holds) throw std::invalid_argument(field + ": expected " + expected);
}

void check_shares(const std::string& field, const std::vector<double>& shares) {
    require(shares.size() == 4, field, "four numbers: spring, summer, autumn, winter");
    for (const double share : shares) require(share >= 0 && share <= 1, field, "0 to 1 each");
}

void check_colors(const std::string& field, const std::vector<Vec3>& colors) {
    require(colors.empty() || colors.size() == 4, field, "none or four colours");
    for (const Vec3& c : colors) require(c.minCoeff() >= 0 && c.maxCoeff() <= 1, field, "0 to 1 each");
}

void check_positive(const std::string& field, double value) {
    require(value > 0 && std::isfinite(value), field, "a finite number above 0");
}

} // namespace

Species default_species() {
    Species s;
    s.growth = default_growth();
    s.name = s.growth.name;
    s.material = "red-maple";
    return s;
}

GrowthParameters at_age(const Species& s, double age) {
    if (!(age >= 0.1 && std::isfinite(age)))
        throw std::invalid_argument("age: is " + shortest_text(age) + ", expected 0.1 years or more");
    GrowthParameters p = s.growth;
    const double f = relative_height(s, age), children = std::pow(f, s.branches_power);
    p.scale *= f;
    p.scale_v *= f;
    p.ratio *= std::pow(f, s.diameter_power - 1);
    for (std::size_t n = 1; n < p.level.size(); ++n) p.level[n].branches *= children;
    while (p.levels > 2 && p.level[std::size_t(p.levels) - 1].branches < 1) --p.levels;
    return p;
}

GrowthParameters in_season(const Species& s, const GrowthParameters& growth, Season season) {
    GrowthParameters p = growth;
    const auto at = std::size_t(season);
    p.leaves *= s.season_leaves[at];
    p.blossoms *= s.season_petals[at];
    p.fruits *= s.season_fruit[at];
    return p;
}

std::vector<Vec3> colors_in_season(const Species& s, Season season) {
    std::vector<Vec3> colors = s.color.empty() ? default_colors() : s.color;
    if (!s.season_leaf_color.empty()) colors[1] = s.season_leaf_color[std::size_t(season)];
    return colors;
}

void check_species(const Species& s) {
    check_growth(s.growth);
    check_leaf_form(s.leaf);
    check_bark_form(s.bark);
    check_shares("season_leaves", s.season_leaves);
    check_shares("season_petals", s.season_petals);
    check_shares("season_fruit", s.season_fruit);
    check_colors("color", s.color);
    check_colors("season_leaf_color", s.season_leaf_color);
    check_positive("mature_age", s.mature_age);
    check_positive("height_rate", s.height_rate);
    check_positive("height_power", s.height_power);
    require(s.diameter_power >= 0 && s.diameter_power <= 4, "diameter_power", "0 to 4");
    require(s.branches_power >= 0 && s.branches_power <= 4, "branches_power", "0 to 4");
}

} // namespace bough
