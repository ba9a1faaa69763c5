#include "growth_params.h"
#include "formats/imports/line_ends.h"
#include "formats/plain_text.h"
#include "lib/growth/weber_penn.h"
#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace bough {

namespace {

const char* const readable =
    "Arbaro XML, a dict of tree-gen or of Blender's Sapling (JSON or Python), an ez-tree preset "
    "or a bough-species document";

std::string joined(const std::vector<std::string>& parts, const char* between) {
    std::string result;
    for (const std::string& part : parts) result += (result.empty() ? "" : between) + part;
    return result;
}

bool named(const std::string& file, std::initializer_list<const char*> parts) {
    const std::string name = lower_case(std::filesystem::path(file).filename().string());
    return std::any_of(parts.begin(), parts.end(), [&](const char* p) { return name.find(p) != std::string::npos; });
}

int count(const ParameterTable& table, std::initializer_list<const char*> names) {
    return static_cast<int>(
        std::count_if(names.begin(), names.end(), [&](const char* name) { return table.has(name); }));
}

GrowthParameters read_dict(std::string_view content, const std::string& file, ParameterNotes& notes) {
    ParameterTable table = parse_parameters(content, file);
    // Names that only one of the two has.
    int tree_gen = count(table, {"g_scale", "g_scale_v", "ratio_power", "base_size", "down_angle", "curve_res",
                                 "length_v", "leaf_blos_num", "tropism", "bend_v", "branch_dist", "split_angle",
                                 "seg_splits", "rotate_v", "curve_v", "leaf_scale", "prune_ratio"});
    int sapling = count(table, {"scale", "scaleV", "ratioPower", "baseSize", "downAngle", "curveRes", "lengthV",
                                "attractUp", "leafScale", "branchDist", "splitAngle", "segSplits", "rotateV", "curveV",
                                "handleType", "bevel", "leaves", "pruneRatio"});
    if (tree_gen == sapling) {
        tree_gen += named(file, {"treegen", "tree-gen", "tree_gen"});
        sapling += named(file, {"sapling"});
    }
    if (tree_gen == sapling)
        throw InputError(file, std::string(tree_gen == 0 ? "has no parameter of a known program"
                                                         : "could be tree-gen's or Sapling's") +
                                   ", expected " + readable);
    return tree_gen > sapling ? read_tree_gen(table, notes) : read_sapling(table, notes);
}

} // namespace

std::vector<std::string> ParameterNotes::lines() const {
    std::vector<std::string> result;
    if (!differs.empty()) result.push_back("honoured in another way: " + joined(differs, "; "));
    if (!not_honoured.empty()) result.push_back("not honoured: " + joined(not_honoured, "; "));
    return result;
}

GrowthParameters read_growth_parameters(std::string_view content, const std::string& file, ParameterNotes& notes) {
    const std::size_t at = text_start(content);
    if (at == content.size()) throw InputError(file, std::string("is empty, expected ") + readable);
    if (content.find('\0') != std::string_view::npos)
        throw InputError(file, std::string("is not text, expected ") + readable);
    const std::optional<std::string> lines = with_line_feeds(content);
    if (lines) content = *lines;
    GrowthParameters p = content[at] == '<' ? read_arbaro(content, file, notes) : read_dict(content, file, notes);
    if (p.name.empty() || p.rules != GrowthRules::arbaro) p.name = stem_of(file);
    p.pipe_exponent = 0; // radii are the file's own
    p.least_radius = std::max(p.least_radius, least_foreign_radius);
    try {
        check_growth(p);
    } catch (const std::invalid_argument& error) {
        throw InputError(file, error.what());
    }
    return p;
}

} // namespace bough
