// arbaro.cpp: Arbaro's species files: <arbaro><species name=""><param name="" value=""/>...; defaults of Arbaro 1.9.9.
#include "formats/plain_text.h"
#include "growth_params.h"
#include <cmath>
#include <limits>
#include <pugixml.hpp>

namespace bough {

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

std::string line_at(std::string_view content, const std::string& file, std::ptrdiff_t offset) {
    return file_line(file, line_of(content, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0))));
}

ParameterTable parse(std::string_view content, const std::string& file, std::string& species) {
    pugi::xml_document xml;
    // pugixml expands no entities but XML's own five, so a file cannot grow in memory.
    const pugi::xml_parse_result parsed = xml.load_buffer(content.data(), content.size());
    if (!parsed)
        throw InputError(line_at(content, file, parsed.offset),
                         std::string("broken XML: ") + parsed.description() + ", expected an Arbaro species");
    const pugi::xml_node root = xml.document_element(), tree = root.child("species");
    if (std::string_view(root.name()) != "arbaro" || !tree)
        throw InputError(line_at(content, file, root.offset_debug()),
                         "<" + std::string(root.name()) + ">, expected Arbaro's <arbaro> with a <species>");
    if (const pugi::xml_node second = tree.next_sibling("species"))
        throw InputError(line_at(content, file, second.offset_debug()), "a second <species>, expected one");
    species = valid_utf8(tree.attribute("name").value());
    ParameterTable table(file);
    LineCounter lines(content);
    for (const pugi::xml_node param : tree.children()) {
        if (param.type() != pugi::node_element) continue;
        ParameterValue value;
        value.line = lines.line_of(static_cast<std::size_t>(std::max<std::ptrdiff_t>(param.offset_debug(), 0)));
        if (std::string_view(param.name()) != "param" || !param.attribute("name") || !param.attribute("value"))
            throw InputError(file_line(file, value.line),
                             "<" + std::string(param.name()) + ">, expected <param name=\"...\" value=\"...\"/>");
        value.kind = ParameterValue::Kind::text;
        value.text = param.attribute("value").value();
        table.add(param.attribute("name").value(), value);
    }
    return table;
}

// The parameters of level n; those of the level below the last are there for leaves, which only look at angles.
void read_level(ParameterTable& t, int n, bool grown, LevelParameters& l) {
    const auto at = [n](const char* name) { return std::to_string(n) + name; };
    const double any = kNoLimit;
    l.down_angle = t.number(at("DownAngle"), n == 0 ? 0 : 30, -180, 180);
    l.down_angle_v = t.number(at("DownAngleV"), 0, -180, 180);
    l.rotate = t.number(at("Rotate"), n == 0 ? 0 : 120, -360, 360);
    l.rotate_v = t.number(at("RotateV"), 0, -360, 360);
    const double most = grown ? 1000 : any;
    l.branches = t.whole(at("Branches"),
                         n == 0   ? 1
                         : n == 1 ? 10
                                  : 5,
                         grown && n == 0 ? 1 : 0, n == 0 ? 10000 : 1000000);
    l.branch_dist = 1 - t.number(at("BranchDist"), n == 0 ? 0 : 1, 0, 1);
    l.length = t.number(at("Length"), n == 0 ? 1 : 0.5, 1e-7, most);
    l.length_v = t.number(at("LengthV"), 0, 0, most);
    l.taper = t.number(at("Taper"), 1, 0, 3);
    l.seg_splits = t.number(at("SegSplits"), 0, 0, grown ? 100 : any);
    l.split_angle = t.number(at("SplitAngle"), 0, 0, 180);
    l.split_angle_v = t.number(at("SplitAngleV"), 0, 0, 180);
    l.curve_res = t.whole(at("CurveRes"), n < 2 ? 3 : 1, 1, 1000);
    l.curve = t.number(at("Curve"), 0, -3600, 3600);
    l.curve_back = t.number(at("CurveBack"), 0, -3600, 3600);
    l.curve_v = t.number(at("CurveV"), 0, -90, 3600);
    if (grown && !(l.length_v < l.length)) t.refuse(at("LengthV"), "less than " + at("Length"));
    if (grown && l.seg_splits > 0 && l.split_angle == 0) t.refuse(at("SplitAngle"), "more than 0, as stems split");
}

void read_tree(ParameterTable& t, GrowthParameters& p) {
    p.shape = t.whole("Shape", 0, 0, 8);
    p.levels = t.whole("Levels", 3, 1, 4);
    p.scale = t.number("Scale", 10, 1e-6, 1e4);
    p.scale_v = t.number("ScaleV", 0, 0, p.scale);
    p.ratio = t.number("Ratio", 0.05, 1e-6, 1);
    p.ratio_power = t.number("RatioPower", 1, -10, 10);
    p.flare = t.number("Flare", 0.5, -1, 100);
    p.radius_scale = t.number("0Scale", 1, 1e-6, 1000);
    p.prune_ratio = t.number("PruneRatio", 0, 0, 1);
    p.prune_width = t.number("PruneWidth", 0.5, 1e-6, 1);
    p.prune_width_peak = t.number("PruneWidthPeak", 0.5, 1e-6, 1 - 1e-6);
    p.prune_power_low = t.number("PrunePowerLow", 0.5, 0, 10);
    p.prune_power_high = t.number("PrunePowerHigh", 0.5, 0, 10);
    for (int n = 0; n < 4; ++n) read_level(t, n, n < p.levels, p.level[std::size_t(n)]);
    LevelParameters& trunk = p.level[0];
    trunk.base_size = t.number("BaseSize", 0.25, 0, 0.999);
    trunk.base_splits = t.whole("0BaseSplits", 0, 0, 100);
    p.trunk_spread = 1 - trunk.branch_dist;
    trunk.branch_dist = 0;
    const double up = t.number("AttractionUp", 0, -100, 100);
    for (int n = 2; n < 4; ++n) p.level[std::size_t(n)].attraction_up = up;
}

void read_leaves(ParameterTable& t, GrowthParameters& p, ParameterNotes& notes) {
    // Fewer leaves of the same area in all.
    const double quality = t.number("LeafQuality", 1, 1e-6, 1), larger = 1 / std::sqrt(quality);
    p.leaves = t.whole("Leaves", 0, -1000000, 1000000) * quality;
    p.leaf_distrib = t.whole("LeafDistrib", 4, 0, 8);
    p.leaf_scale = t.number("LeafScale", 0.2, 1e-6, 1000) * larger;
    p.leaf_scale_x = t.number("LeafScaleX", 0.5, 1e-6, 1000);
    p.leaf_stem = t.number("LeafStemLen", 0.5, -100, 100);
    p.leaf_bend = t.number("LeafBend", 0.3, 0, 1);
    t.not_honoured({"LeafShape"}, "leaves are kites", notes.not_honoured);
}

} // namespace

GrowthParameters read_arbaro(std::string_view content, const std::string& file, ParameterNotes& notes) {
    GrowthParameters p;
    p.rules = GrowthRules::arbaro;
    ParameterTable t = parse(content, file, p.name);
    read_tree(t, p);
    read_leaves(t, p, notes);
    t.not_honoured({"Lobes", "LobeDepth", "0ScaleV"}, "bodies are round", notes.not_honoured);
    t.not_honoured({"Smooth"}, "of the mesh alone", notes.not_honoured);
    t.known({"Species"});
    for (int n = 0; n < p.levels; ++n)
        if (p.level[std::size_t(n)].curve_v < 0)
            notes.differs.push_back(std::to_string(n) +
                                    "CurveV (a helix, as Arbaro's manual has it; its program makes none)");
    for (int n = 0; n < p.levels; ++n)
        if (p.level[std::size_t(n)].seg_splits > 0 || p.level[std::size_t(n)].base_splits > 0) {
            notes.differs.push_back("SplitAngle (the stem turns too where it splits, as in the paper)");
            break;
        }
    t.finish();
    return p;
}

} // namespace bough
