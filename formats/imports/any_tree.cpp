#include "any_tree.h"
#include "formats/documents/scene.h"
#include "formats/documents/tree.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "import.h"
#include "lib/base/counted.h"
#include "refused.h"
#include <stdexcept>

namespace bough {

bool must_be_converted(std::string_view content, const std::string& name) {
    if (is_tree(content) || is_scene(content)) return false;
    if (is_importable(content, name) || is_known_unread(content, name)) return true;
    // What might have been a document of ours, its reader says best what is wrong with; of all else, what could be read.
    const std::size_t first = text_start(content.substr(0, 4096));
    return first < content.size() && content[first] != '{' && content[first] != '[' &&
           content.substr(0, 4096).find('\0') == std::string_view::npos;
}

Material own_material(const Splines& splines, const std::string& name) {
    if (splines.material.empty()) return wood_presets().front();
    if (const Material* preset = find_wood(splines.material)) return *preset;
    throw InputError(name + ": /material", "is \"" + splines.material +
                                               "\", expected a preset (see treeconvert --list-materials); "
                                               "treeconvert --material overrides it");
}

std::vector<std::string> repairs(const SegmentReport& report) {
    std::vector<std::string> lines;
    const auto note = [&](std::int64_t count, const char* one, const char* many) {
        if (count > 0) lines.push_back(counted(count, one, many));
    };
    note(report.merged_points, "near-coincident point merged", "near-coincident points merged");
    note(report.dropped_branches, "branch without length left out, what grows on it moved to its parent",
         "branches without length left out, what grows on them moved to their parent");
    note(report.thin_points, "radius raised to the least that has a mass", "radii raised to the least that has a mass");
    return lines;
}

std::string joined_fruit(const SegmentReport& report) {
    return counted(report.joined_fruit, "fruit is", "fruit are") +
           " one with the wood that bears it, and not drawn; more bodies show more";
}

void require_bodies(const Tree& tree, const std::string& name) {
    if (tree.size_bodies() == 0) throw InputError(name, "holds no branch with a length, expected a tree");
}

Tree tree_of_splines(const Splines& splines, const std::string& name, std::vector<std::string>& notes) {
    SegmentReport report;
    Tree tree;
    try {
        tree = segment(splines, own_material(splines, name), {}, &report);
    } catch (const std::invalid_argument& error) { // more than can be numbered
        throw InputError(name, error.what());
    }
    require_bodies(tree, name);
    for (const std::string& line : repairs(report)) notes.push_back(line);
    if (report.joined_fruit > 0) notes.push_back(joined_fruit(report));
    return tree;
}

} // namespace bough
