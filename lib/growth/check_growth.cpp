#include "../base/shortest_text.h"
#include "in_range.h"
#include "sapling_family.h"
#include <stdexcept>

namespace bough {

namespace {

void below(const std::string& name, double value, double least, double limit) {
    if (!(value >= least && value < limit))
        refuse(name, value, "at least " + shortest_text(least) + " and less than " + shortest_text(limit));
}

// Nothing that has a size is smaller than this, in metres or over another size: a body of it would have no mass in double.
constexpr double kSmallest = 1e-6;

void positive(const std::string& name, double value, double most) {
    if (!(value >= kSmallest && value <= most))
        refuse(name, value, shortest_text(kSmallest) + " to " + shortest_text(most));
}

void check_angles(const std::string& at, const LevelParameters& l) {
    within(at + "down_angle", l.down_angle, -360, 360);
    within(at + "down_angle_v", l.down_angle_v, -360, 360);
    within(at + "rotate", l.rotate, -360, 360);
    within(at + "rotate_v", l.rotate_v, -360, 360);
}

void check_level(const std::string& at, const LevelParameters& l, bool trunk, GrowthRules rules) {
    const bool segments = rules == GrowthRules::arbaro || rules == GrowthRules::tree_gen;
    check_angles(at, l);
    within(at + "branches", l.branches, 0, !trunk ? 1e6 : segments ? 1e4 : 1);
    below(at + "base_size", l.base_size, 0, 1);
    positive(at + "radius_mod", l.radius_mod, 1e3);
    within(at + "attraction_up", l.attraction_up, -100, 100);
    within(at + "branch_dist", l.branch_dist, 0, rules == GrowthRules::tree_gen ? 100 : 1);
    positive(at + "length", l.length, 1e3);
    below(at + "length_v", l.length_v, 0, l.length);
    within(at + "taper", l.taper, 0, 3);
    within(at + "taper_power", l.taper_power, 0.1, 10);
    within(at + "curve_res", l.curve_res, 1, 1000);
    within(at + "seg_splits", l.seg_splits, 0, 100);
    within(at + "base_splits", l.base_splits, 0, 100);
    if (rules == GrowthRules::bough && l.curve_res < 2 && (l.seg_splits > 0 || l.base_splits > 0))
        refuse(at + "curve_res", l.curve_res, "2 or more, as the stems split where segments meet");
    // Each segment's end after the first multiplies the stem's tips.
    const double tips =
        (1 + (l.base_splits > 0 ? l.base_splits : l.seg_splits)) * std::pow(1 + l.seg_splits, l.curve_res - 2);
    if ((rules == GrowthRules::bough || rules == GrowthRules::arbaro) && l.curve_res > 1 && tips > 1e6)
        refuse(at + "seg_splits", l.seg_splits, "fewer, so that a stem splits into at most 1e6 over its curve_res");
    within(at + "split_angle", l.split_angle, -360, 360);
    within(at + "split_angle_v", l.split_angle_v, -360, 360);
    within(at + "curve", l.curve, -3600, 3600);
    within(at + "curve_back", l.curve_back, -3600, 3600);
    within(at + "curve_v", l.curve_v, -3600, 3600);
    within(at + "bend_v", l.bend_v, -3600, 3600);
}

void check_sapling(const SaplingRules& s) {
    within("sapling.second_shape", s.second_shape, 0, 10);
    for (const double part : s.custom_shape) within("sapling.custom_shape", part, 0.01, 1);
    for (const double part : s.attract_out) within("sapling.attract_out", part, 0, 1);
    within("sapling.split_height", s.split_height, 0, 1);
    within("sapling.split_bias", s.split_bias, -10, 10);
    within("sapling.taper_crown", s.taper_crown, 0, 10);
    within("sapling.rings", s.rings, 0, 1000);
    within("sapling.branch_dist", s.branch_dist, 0.1, 100);
    within("sapling.root_flare", s.root_flare, 1, 100);
    within("sapling.leaf_scale_taper", s.leaf_scale_taper, -1, 1);
    within("sapling.leaf_angle", s.leaf_angle, -360, 360);
}

// A parameter that the rules do not look at keeps the value that means nothing.
void untouched(const std::string& name, double value, double none) {
    if (value != none) refuse(name, value, shortest_text(none) + ": rules without it");
}

void check_rules(const GrowthParameters& p) {
    const bool ours = p.rules == GrowthRules::bough, bends = p.rules == GrowthRules::tree_gen;
    for (std::size_t n = 0; n < std::size_t(p.levels); ++n) {
        const std::string at = "level[" + std::to_string(n) + "].";
        if (!bends) untouched(at + "bend_v", p.level[n].bend_v, 0);
        if (!ours) untouched(at + "taper_power", p.level[n].taper_power, 1);
    }
    if (!bends) {
        untouched("tropism", p.tropism.norm(), 0);
        untouched("blossom_rate", p.blossom_rate, 0);
    }
    if (ours) {
        untouched("trunk_spread", p.trunk_spread, 0);
    } else {
        untouched("split_exponent", p.split_exponent, 0);
        untouched("most_slender", p.most_slender, 0);
        untouched("crown_top", p.crown_top, -1);
        untouched("leading_shoot", p.leading_shoot, 0);
        untouched("blossoms", p.blossoms, 0);
        untouched("fruits", p.fruits, 0);
    }
}

} // namespace

void check_growth(const GrowthParameters& p) {
    const bool ours = p.rules == GrowthRules::bough, sapling = p.rules == GrowthRules::sapling;
    within("shape", p.shape, 0, sapling ? 10 : 8);
    within("levels", p.levels, 1, 4);
    positive("scale", p.scale, 1e4);
    ours ? below("scale_v", p.scale_v, 0, p.scale) : within("scale_v", p.scale_v, 0, p.scale);
    positive("ratio", p.ratio, 1);
    within("ratio_power", p.ratio_power, ours ? 0 : -10, 10);
    positive("radius_scale", p.radius_scale, 1e3);
    below("radius_scale_v", p.radius_scale_v, 0, p.radius_scale);
    within("flare", p.flare, ours ? 0 : -1, 100);
    within("trunk_spread", p.trunk_spread, 0, 1e4);
    for (const double part : {p.tropism.x(), p.tropism.y(), p.tropism.z()}) within("tropism", part, -1000, 1000);
    below("prune_base", p.prune_base, -1, 1);
    within("leaf_stem", p.leaf_stem, -100, 100);
    within("blossom_rate", p.blossom_rate, 0, 1);
    if (sapling) check_sapling(p.sapling);
    within("prune_ratio", p.prune_ratio, 0, 1);
    positive("prune_width", p.prune_width, 10);
    if (!(p.prune_width_peak > 0 && p.prune_width_peak < 1))
        refuse("prune_width_peak", p.prune_width_peak, "more than 0 and less than 1");
    within("prune_power_low", p.prune_power_low, 0, 10);
    within("prune_power_high", p.prune_power_high, 0, 10);
    for (int n = 0; n < p.levels; ++n) check_level("level[" + std::to_string(n) + "].", p.level[n], n == 0, p.rules);
    for (int n = 0; n < p.levels && sapling; ++n)
        if (sapling_pieces(p, n) > kMostPieces)
            refuse("level[" + std::to_string(n) + "].seg_splits", p.level[std::size_t(n)].seg_splits,
                   "fewer, so that a stem splits into at most 1e6 over its curve_res");
    check_rules(p);
    within("leaves", p.leaves, -1e6, 1e6);
    within("fruits", p.fruits, 0, 1e6);
    within("leaf_distrib", p.leaf_distrib, 0, sapling ? 10 : 8);
    if (!p.leaf_angles.empty() && p.leaf_angles.size() != 4)
        refuse("leaf_angles", double(p.leaf_angles.size()), "none or 4: down_angle, down_angle_v, rotate, rotate_v");
    for (const double angle : p.leaf_angles) within("leaf_angles", angle, -360, 360);
    within("blossoms", p.blossoms, 0, 1e6);
    within("petals", p.petals, 1, 1000);
    positive("petal_scale", p.petal_scale, 1e3);
    positive("petal_scale_x", p.petal_scale_x, 1e3);
    within("fruit_stalk", p.fruit_stalk, 0.01, 1000);
    if (p.pipe_exponent != 0) within("pipe_exponent", p.pipe_exponent, 1, 4);
    if (p.levels < 4 && p.leaves != 0 && p.leaf_angles.empty())
        check_angles("level[" + std::to_string(p.levels) + "].", p.level[p.levels]);
    positive("leaf_scale", p.leaf_scale, 1e3);
    below("leaf_scale_v", p.leaf_scale_v, 0, p.leaf_scale);
    positive("leaf_scale_x", p.leaf_scale_x, 1e3);
    within("leaf_bend", p.leaf_bend, 0, 1);
    positive("fruit_radius", p.fruit_radius, 1e3);
    if (p.split_exponent != 0) within("split_exponent", p.split_exponent, 1, 4);
    within("least_radius", p.least_radius, 0, 10);
    within("most_slender", p.most_slender, 0, 1e6);
    within("leading_shoot", p.leading_shoot, 0, 0.5);
    if (p.leading_shoot > 0 && p.levels < 2)
        throw std::invalid_argument(
            "leading_shoot: is there with levels 1, of which the trunk is the last, expected 2 to 4");
    if (p.crown_top != -1) {
        within("crown_top", p.crown_top, 0.01, 1);
        if (p.shape == 3 || p.shape == 6 || p.shape == 8)
            throw std::invalid_argument("crown_top: is there with shape " + std::to_string(p.shape) +
                                        ", which is not narrowest at the top, expected shape 0, 1, 2, 4, 5 or 7");
    }
    if (p.most_sag != 0) within("most_sag", p.most_sag, 0.01, 3);
    if (const auto defect = check(p.wood))
        throw std::invalid_argument("wood." + defect->field + ": " + defect->message);
}

} // namespace bough
