// sapling.cpp: presets of Blender's add_curve_sapling, defaults of its operator in Blender 3.4. Presets of older
// versions lack leaf angles of their own and have one attractUp.
#include "growth_params.h"
#include "lib/growth/sapling_family.h"
#include "lib/growth/weber_penn.h"
#include <algorithm>
#include <numeric>

namespace bough {

namespace {

using Four = std::array<double, 4>;

Four read_column(ParameterTable& t, GrowthParameters& p, const char* name, const Four& fallback, double least,
                 double most, double LevelParameters::*value, bool whole = false) {
    const Four v = t.four(name, fallback, least, most, p.levels, whole);
    for (std::size_t n = 0; n < 4; ++n) p.level[n].*value = v[n];
    return v;
}

int shape(ParameterTable& t, const char* name, int fallback, bool custom) {
    const int number = t.whole(name, fallback, 0, 10);
    if (number == 9 || (number == 8 && !custom)) t.refuse(name, custom ? "0 to 8 or 10" : "0 to 7 or 10");
    return number;
}

// Sapling's automatic taper: stems become thinner in proportion to what is left of the longest line of tips beyond them.
void taper_by_length(GrowthParameters& p) {
    Four line{};
    double product = 1;
    for (std::size_t n = 0; n < 4; ++n) {
        const double top = n == 0 ? 1 : shape_ratio(p, n == 1 ? p.shape : p.sapling.second_shape, 0);
        line[n] = product *= p.level[n].length * top;
    }
    for (int n = 0; n < p.levels; ++n) {
        const double left = std::accumulate(line.begin() + n, line.begin() + p.levels, 0.0);
        p.level[std::size_t(n)].taper *= left > 0 ? line[std::size_t(n)] / left : 1;
    }
}

void read_levels(ParameterTable& t, GrowthParameters& p) {
    using L = LevelParameters;
    read_column(t, p, "length", {1, 0.3, 0.6, 0.45}, 1e-6, 1000, &L::length);
    // A part of the length here, a length there.
    const Four vary = t.four("lengthV", {0, 0, 0, 0}, 0, 0.999, p.levels);
    for (std::size_t n = 0; n < 4; ++n) p.level[n].length_v = vary[n] * p.level[n].length;
    read_column(t, p, "branches", {50, 30, 10, 10}, 0, 1e6, &L::branches, true);
    p.level[0].branches = 1;
    const Four res = t.four("curveRes", {3, 5, 3, 1}, 1, 1000, p.levels, true);
    // Of levels that are not grown anything is taken, which no int need hold.
    for (std::size_t n = 0; n < std::size_t(p.levels); ++n) p.level[n].curve_res = static_cast<int>(res[n]);
    read_column(t, p, "curve", {0, -40, -40, 0}, -3600, 3600, &L::curve);
    read_column(t, p, "curveV", {20, 50, 75, 0}, -3600, 3600, &L::curve_v);
    read_column(t, p, "curveBack", {0, 0, 0, 0}, -3600, 3600, &L::curve_back);
    read_column(t, p, "segSplits", {0, 0, 0, 0}, 0, 100, &L::seg_splits);
    read_column(t, p, "splitAngle", {0, 0, 0, 0}, -360, 360, &L::split_angle);
    read_column(t, p, "splitAngleV", {0, 0, 0, 0}, -360, 360, &L::split_angle_v);
    read_column(t, p, "downAngle", {90, 60, 45, 45}, -360, 360, &L::down_angle);
    read_column(t, p, "downAngleV", {0, -50, 10, 10}, -360, 360, &L::down_angle_v);
    read_column(t, p, "rotate", {137.5, 137.5, 137.5, 137.5}, -360, 360, &L::rotate);
    read_column(t, p, "rotateV", {0, 0, 0, 0}, -360, 360, &L::rotate_v);
    read_column(t, p, "taper", {1, 1, 1, 1}, 0, 1, &L::taper);
    read_column(t, p, "radiusTweak", {1, 1, 1, 1}, 1e-6, 1, &L::radius_mod);
    p.sapling.attract_out = t.four("attractOut", {0, 0, 0, 0}, 0, 1, p.levels);
    if (t.has("attractUp") && !t.is_list("attractUp")) {
        const double up = t.number("attractUp", 0, -100, 100);
        for (std::size_t n = 2; n < 4; ++n) p.level[n].attraction_up = up;
    } else
        read_column(t, p, "attractUp", {0, 0, 0, 0}, -100, 100, &L::attraction_up);
    double bare = std::min(0.999, t.number("baseSize", 0.4, 0, 1));
    const double further = t.number("baseSize_s", 0.25, 0, 1);
    for (std::size_t n = 0; n < 4; ++n, bare *= further) p.level[n].base_size = bare;
    p.level[0].base_splits = t.whole("baseSplits", 0, 0, 100);
    for (int n = 0; n < p.levels; ++n)
        if (sapling_pieces(p, n) > kMostPieces)
            t.refuse("segSplits", "fewer, so that a stem of level " + std::to_string(n) +
                                      " splits into at most 1e6 over its curveRes");
}

void read_rules(ParameterTable& t, GrowthParameters& p) {
    SaplingRules& s = p.sapling;
    p.shape = shape(t, "shape", 7, true);
    s.second_shape = shape(t, "shapeS", 4, false);
    s.custom_shape = t.four("customShape", s.custom_shape, 0.01, 1, 4);
    s.split_by_length = t.flag("splitByLen", false);
    s.split_height = t.number("splitHeight", 0.2, 0, 1);
    s.split_bias = t.number("splitBias", 0, -10, 10);
    s.taper_crown = t.number("taperCrown", 0, 0, 10);
    s.rings = t.whole("nrings", 0, 0, 1000);
    s.branch_dist = t.number("branchDist", 1, 0.1, 100);
    s.root_flare = t.number("rootFlare", 1, 1, 100);
    s.old_down_angle = t.flag("useOldDownAngle", false);
    s.use_parent_angle = t.flag("useParentAngle", true);
    const std::string mode = t.text("rMode", "rotate");
    if (mode == "original")
        s.rotation = SaplingRules::Rotation::original;
    else if (mode == "random")
        s.rotation = SaplingRules::Rotation::random;
    else if (mode != "rotate")
        t.refuse("rMode", "original, rotate or random");
}

void read_leaves(ParameterTable& t, GrowthParameters& p) {
    p.leaves = t.whole("leaves", 25, -1000000, 1000000);
    p.leaf_distrib = shape(t, "leafDist", 6, false);
    p.leaf_scale = t.number("leafScale", 0.17, 1e-6, 1000);
    p.leaf_scale_v = p.leaf_scale * t.number("leafScaleV", 0, 0, 0.999);
    p.leaf_scale_x = t.number("leafScaleX", 1, 1e-6, 1000);
    p.sapling.leaf_scale_taper = t.number("leafScaleT", 0, -1, 1);
    p.sapling.leaf_angle = t.number("leafangle", 0, -360, 360);
    p.sapling.level_leaves = t.flag("horzLeaves", true);
    p.leaf_bend = 0;
    // A preset without leafDownAngle is an old one, whose leaves take the angles of the level below the last.
    const LevelParameters& l = p.level[std::size_t(std::min(p.levels, 3))];
    const bool old = !t.has("leafDownAngle");
    p.leaf_angles = {t.number("leafDownAngle", l.down_angle, -360, 360),
                     t.number("leafDownAngleV", old ? l.down_angle_v : 10, -360, 360),
                     t.number("leafRotate", old ? l.rotate : 137.5, -360, 360),
                     t.number("leafRotateV", old ? l.rotate_v : 0, -360, 360)};
}

void read_pruning(ParameterTable& t, GrowthParameters& p) {
    const double ratio = t.number("pruneRatio", 1, 0, 1);
    p.prune_ratio = t.flag("prune", false) ? ratio : 0;
    const bool on = p.prune_ratio > 0;
    const double any = 1e30, width = t.number("pruneWidth", 0.4, 0, on ? 10 : any),
                 peak = t.number("pruneWidthPeak", 0.6, on ? 1e-6 : 0, on ? 1 - 1e-6 : any),
                 low = t.number("prunePowerLow", 0.001, on ? 0 : -any, on ? 10 : any),
                 high = t.number("prunePowerHigh", 0.5, on ? 0 : -any, on ? 10 : any),
                 base = t.number("pruneBase", 0.3, 0, 1);
    if (!on) return;
    if (width <= 0) t.refuse("pruneWidth", "more than 0");
    p.prune_width = width;
    p.prune_width_peak = peak;
    p.prune_power_low = low;
    p.prune_power_high = high;
    p.prune_base = std::min(base, p.level[0].base_size);
}

void name_the_rest(ParameterTable& t, ParameterNotes& notes) {
    auto& out = notes.not_honoured;
    t.not_honoured({"bevel",      "bevelRes",  "resU",       "handleType",  "closeTip",  "makeMesh",    "useArm",
                    "previewArm", "armAnim",   "leafAnim",   "armLevels",   "boneStep",  "frameRate",   "loopFrames",
                    "wind",       "gust",      "gustF",      "af1",         "af2",       "af3",         "windSpeed",
                    "windGust",   "chooseSet", "presetName", "limitImport", "overwrite", "leafDupliObj"},
                   "of Blender's curves, mesh, armature or panels", out);
    t.not_honoured({"leafShape"}, "leaves are kites", out);
    t.not_honoured({"seed"}, "--seed decides", out);
    t.not_honoured({"showLeaves"}, "--leaves decides", out);
    t.not_honoured({"bend"}, "Sapling itself sets it to 0", out);
    t.not_honoured({"startCurv"}, "Sapling itself has dropped it", out);
}

} // namespace

GrowthParameters read_sapling(ParameterTable& t, ParameterNotes& notes) {
    GrowthParameters p;
    p.rules = GrowthRules::sapling;
    p.levels = t.whole("levels", 3, 1, 4);
    p.scale = t.number("scale", 13, 1e-6, 1e4);
    p.scale_v = t.number("scaleV", 3, 0, p.scale);
    p.ratio = t.number("ratio", 0.015, 1e-6, 1);
    p.ratio_power = t.number("ratioPower", 1.2, 0, 10);
    p.radius_scale = t.number("scale0", 1, 1e-6, 1000);
    p.radius_scale_v = p.radius_scale * t.number("scaleV0", 0.2, 0, 0.999);
    p.least_radius = t.number("minRadius", 0, 0, 10);
    read_rules(t, p);
    read_levels(t, p);
    if (t.flag("autoTaper", true)) taper_by_length(p);
    read_leaves(t, p);
    read_pruning(t, p);
    name_the_rest(t, notes);
    t.finish();
    return p;
}

} // namespace bough
