#include "converted.h"
#include "file_names.h"
#include "formats/documents/scene.h"
#include "formats/documents/tree.h"
#include "formats/imports/refused.h"
#include "formats/mapped.h"
#include "formats/plain_text.h"
#include "import_file.h"
#include "lib/base/counted.h"

namespace bough {
namespace {

bool must_be_converted(std::string_view content, const std::string& name) {
    if (is_tree(content) || is_scene(content)) return false;
    if (is_importable(content, name) || is_known_unread(content, name)) return true;
    // What might have been a document of ours, its reader says best what is wrong with; of all else, what could be read.
    const std::size_t first = text_start(content.substr(0, 4096));
    return first < content.size() && content[first] != '{' && content[first] != '[' &&
           content.substr(0, 4096).find('\0') == std::string_view::npos;
}

TreeOfFile converted(const Splines& splines, ImportNotes found, const std::string& file) {
    const std::string name = input_name(file);
    TreeOfFile made;
    SegmentReport report;
    made.tree = segment(splines, own_material(splines, name), {}, &report);
    require_bodies(made.tree, name);
    for (const std::string& line : found.lines) made.notes.push_back(name + ": " + line);
    for (const std::string& line : repairs(report)) made.notes.push_back(name + ": " + line);
    if (report.joined_fruit > 0) made.notes.push_back(name + ": " + joined_fruit(report));
    const std::string to = (file == "-" ? "tree" : stem_of(file)) + ".tree.json";
    const bool meshed = found.format.find("SpeedTree") != std::string::npos;
    made.notes.push_back(
        name + ": " + found.format + ", converted to " + counted(made.tree.size_bodies(), "body", "bodies") +
        " with the defaults of treeconvert" +
        (meshed ? " (treesim's --skin FILE shows its mesh where the tree was converted by hand)" : "") +
        "; by hand: treeconvert " + in_shell(file) + " -o " + in_shell(to));
    made.imported = std::move(found);
    return made;
}

} // namespace

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

bool is_converted(const std::string& file) {
    return file != "-" && must_be_converted(MappedInput(file).content(), input_name(file));
}

TreeOfFile read_any_tree(const std::string& file) {
    if (!is_converted(file)) return read_any_tree(Input(file), file);
    ImportNotes found;
    const Splines splines = read_import(file, {}, found);
    return converted(splines, std::move(found), file);
}

TreeOfFile read_any_tree(const Input& input, const std::string& file) {
    if (!must_be_converted(input.content(), input.name())) return {read_tree(input), {}, {}};
    ImportNotes found;
    const Splines splines = read_import(input.all(), file, found);
    return converted(splines, std::move(found), file);
}

} // namespace bough
