// tree_gen.cpp: the parameters of friggog's tree-gen, defaults of its tree_param.py.
#include "growth_params.h"
#include <cmath>

namespace bough {

namespace {

using Four = std::array<double, 4>;

void read_tree_gen_levels(ParameterTable& t, GrowthParameters& p) {
    const int grown = p.levels;
    const auto column = [&](const char* name, const Four& fallback, double least, double most, bool whole,
                            double LevelParameters::*value) {
        const Four v = t.four(name, fallback, least, most, grown, whole);
        for (std::size_t n = 0; n < 4; ++n) p.level[n].*value = v[n];
    };
    using L = LevelParameters;
    column("base_size", {0.3, 0.02, 0.02, 0.02}, 0, 0.999, false, &L::base_size);
    column("down_angle", {0, 60, 45, 45}, -360, 360, false, &L::down_angle);
    column("down_angle_v", {0, -50, 10, 10}, -360, 360, false, &L::down_angle_v);
    column("rotate", {0, 140, 140, 77}, -360, 360, false, &L::rotate);
    column("rotate_v", {0, 0, 0, 0}, -360, 360, false, &L::rotate_v);
    column("branches", {1, 50, 30, 10}, 0, 1e6, true, &L::branches);
    column("length", {1, 0.3, 0.6, 0}, 1e-6, 1000, false, &L::length);
    column("length_v", {0, 0, 0, 0}, 0, 1000, false, &L::length_v);
    column("taper", {1, 1, 1, 1}, 0, 3, false, &L::taper);
    column("seg_splits", {0, 0, 0, 0}, 0, 100, false, &L::seg_splits);
    column("split_angle", {40, 0, 0, 0}, -360, 360, false, &L::split_angle);
    column("split_angle_v", {5, 0, 0, 0}, -360, 360, false, &L::split_angle_v);
    column("curve", {0, -40, -40, 0}, -3600, 3600, false, &L::curve);
    column("curve_back", {0, 0, 0, 0}, -3600, 3600, false, &L::curve_back);
    column("curve_v", {20, 50, 75, 0}, -3600, 3600, false, &L::curve_v);
    column("bend_v", {0, 50, 0, 0}, -3600, 3600, false, &L::bend_v);
    column("branch_dist", {0, 0, 0, 0}, 0, 100, false, &L::branch_dist);
    column("radius_mod", {1, 1, 1, 1}, 1e-6, 1000, false, &L::radius_mod);
    const Four res = t.four("curve_res", {5, 5, 3, 1}, 1, 1000, grown, true);
    // Of levels that are not grown anything is taken, which no int need hold.
    for (std::size_t n = 0; n < std::size_t(grown); ++n) p.level[n].curve_res = static_cast<int>(res[n]);
    for (int n = 0; n < grown; ++n)
        if (!(p.level[std::size_t(n)].length_v < p.level[std::size_t(n)].length))
            t.refuse("length_v", "less than length for level " + std::to_string(n));
    if (p.level[0].branches < 1) t.refuse("branches", "at least 1 trunk for level 0");
    // tree-gen turns a lone trunk at random and never leans one.
    p.level[0].rotate = p.level[0].rotate_v = p.level[0].down_angle = p.level[0].down_angle_v = 0;
    p.level[0].base_splits = std::max(0, t.whole("base_splits", 0, -100, 100));
}

void read_tree_gen_leaves(ParameterTable& t, GrowthParameters& p, ParameterNotes& notes) {
    p.leaves = t.whole("leaf_blos_num", 40, -1000000, 1000000);
    p.leaf_scale = t.number("leaf_scale", 0.17, 1e-6, 1000);
    p.leaf_scale_x = t.number("leaf_scale_x", 1, 1e-6, 1000);
    p.leaf_bend = t.number("leaf_bend", 0.6, 0, 1);
    p.blossom_rate = t.number("blossom_rate", 0, 0, 1);
    const double flower = t.number("blossom_scale", 0, 0, 1000);
    if (p.blossom_rate > 0 && flower <= 0) t.refuse("blossom_scale", "more than 0 where blossom_rate is");
    if (flower > 0) p.petal_scale = flower;
    t.not_honoured({"leaf_shape"}, "leaves are kites", notes.not_honoured);
    if (p.blossom_rate > 0) t.not_honoured({"blossom_shape"}, "flowers have five petals", notes.not_honoured);
    if (p.leaf_bend > 0 && t.has("leaf_bend"))
        notes.differs.push_back("leaf_bend (leaves turn up, too, not outward only)");
}

} // namespace

GrowthParameters read_tree_gen(ParameterTable& t, ParameterNotes& notes) {
    GrowthParameters p;
    p.rules = GrowthRules::tree_gen;
    p.shape = t.whole("shape", 7, 0, 8);
    p.levels = t.whole("levels", 3, 1, 4);
    p.scale = t.number("g_scale", 13, 1e-6, 1e4);
    p.scale_v = t.number("g_scale_v", 3, 0, p.scale);
    p.ratio = t.number("ratio", 0.015, 1e-6, 1);
    p.ratio_power = t.number("ratio_power", 1.2, -10, 10);
    p.flare = t.number("flare", 0.6, -1, 100);
    p.prune_ratio = t.number("prune_ratio", 0, 0, 1);
    p.prune_width = t.number("prune_width", 0.5, 1e-6, 10);
    p.prune_width_peak = t.number("prune_width_peak", 0.5, 1e-6, 1 - 1e-6);
    p.prune_power_low = t.number("prune_power_low", 0.5, 0, 10);
    p.prune_power_high = t.number("prune_power_high", 0.5, 0, 10);
    read_tree_gen_levels(t, p);
    read_tree_gen_leaves(t, p, notes);
    const std::vector<double> pull = t.three("tropism", {0, 0, 0.5}, -1000, 1000);
    p.tropism = Vec3(pull[0], pull[2], -pull[1]); // z up to y up
    t.not_honoured({"bevel_res"}, "of the mesh alone", notes.not_honoured);
    t.not_honoured({"leaves"}, "tree-gen's name is leaf_blos_num", notes.not_honoured);
    if (t.has("base_splits") && t.whole("base_splits", 0, -100, 100) < 0)
        notes.not_honoured.push_back("base_splits (tree-gen itself makes none where it is negative)");
    for (int n = 0; n < p.levels; ++n)
        if (p.level[std::size_t(n)].curve_v < 0) {
            notes.differs.push_back("curve_v (a helix of one turn over the stem)");
            break;
        }
    t.finish();
    return p;
}

} // namespace bough
