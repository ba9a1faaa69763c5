#include "converted.h"
#include "file_names.h"
#include "formats/documents/tree.h"
#include "formats/imports/any_tree.h"
#include "formats/in_shell.h"
#include "formats/mapped.h"
#include "formats/plain_text.h"
#include "import_file.h"
#include "lib/base/counted.h"

namespace bough {
namespace {

TreeOfFile converted(const Splines& splines, ImportNotes found, const std::string& file) {
    const std::string name = input_name(file);
    TreeOfFile made;
    std::vector<std::string> lines = found.lines;
    made.tree = tree_of_splines(splines, name, lines);
    for (const std::string& line : lines) made.notes.push_back(name + ": " + line);
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
