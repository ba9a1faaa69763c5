// treegen: a tree as splines, grown from parameters or imported from another program's file.
#include "file_names.h"
#include "formats/documents/splines.h"
#include "formats/exports/skeleton_writer.h"
#include "formats/files.h"
#include "growth.h"
#include "import_file.h"
#include "import_stats.h"
#include "lib/base/counted.h"
#include "tool.h"
#include <iostream>

namespace {

using namespace bough;

struct Options {
    CommonOptions common;
    GrowthOptions growth;
    ImportChoice choice;
    std::string import;
    bool strict = false, stats = false;
};

const ToolInfo info = {
    .name = "treegen",
    .about = "Makes a tree as splines: grown, grown into a volume, or imported from another program.",
    .usage = "treegen [--species NAME] [--bodies N] [--seed N] [--leaves] [-o FILE]\n"
             "treegen --params FILE [--bodies N] [--seed N] [--leaves] [-o FILE]\n"
             "treegen --envelope sphere|cone|box|FILE [--leaves] [-o FILE]\n"
             "treegen --import FILE [--units UNIT] [--up AXIS] [--leaves] [-o FILE]",
    .details =
        "The output is bough splines (.json, .safetensors), or a skeleton for other programs: SWC (.swc) or a "
        "treetools "
        "tree file (.txt), in metres and Z up. treeconvert makes a tree of bodies of it.\n"
        "--import reads SpeedTree raw XML, armatures and lines of FBX, glTF and COLLADA, cylinders of TreeQSM, "
        "SimpleForest and aRchi, treetools tree files, SWC, MTG, ez-tree's branches, PLY skeletons, OBJ lines and "
        "curves, curves of Blender (CSV, JSON), and bough splines. The content tells which one a file is.",
    .examples = "treegen --bodies 2000 --seed 7 | treeconvert - -o tree.json\n"
                "treegen --import oak.xml --leaves --stats -o oak.splines.json",
    .formats = {"json", "safetensors", "swc", "treetools"},
    .first = {"--species", "--list-species", "--params", "--age", "--season", "--bodies", "--seed", "--leaves",
              "--petals", "--fruit", "--envelope", "--envelope-size", "--import", "--units", "--up"}};

void declare(OptionList& list, Options& o) {
    add_growth_options(list, o.growth);
    list.group("Input");
    list.add("--import", o.import, "Import this file instead of growing; - for stdin").takes("FILE");
    list.add_flag("--strict", o.strict, "With --import: guesses, repairs and omissions of the reader are errors");
    add_import_options(list, o.choice);
    list.add_flag("--stats", o.stats, "With --import: print what was understood of the file on stderr");
}

void refuse_contradictions(const Options& o) {
    bough::refuse_contradictions(o.growth, !o.import.empty());
    if (o.strict && o.import.empty()) throw UsageError("--strict: only with --import");
    if (o.stats && o.import.empty()) throw UsageError("--stats: only with --import");
    if (o.choice.trunk_diameter && o.import.empty()) throw UsageError("--trunk-diameter: only with --import");
    if (o.choice.scan_radii && o.import.empty()) throw UsageError("--scan-radii: only with --import");
    if (o.choice.keep_place && o.import.empty()) throw UsageError("--keep-place: only with --import");
    refuse_overwriting({{"--params", o.growth.params}, {"--envelope", o.growth.envelope.envelope}},
                       {{"-o", o.common.output}});
    if (!o.import.empty() || !o.growth.envelope.envelope.empty()) return;
    if (!o.choice.units.empty() && o.growth.params.empty())
        throw UsageError("--units: only with --import, --envelope FILE or the preset of ez-tree, which has none");
    if (!o.choice.up.empty()) throw UsageError("--up: only with --import or --envelope FILE");
}

// Leaves and fruit come only when asked for, from a file as from growth; what was left out is said.
void leave_out(Splines& splines, const GrowthOptions& o, std::vector<std::string>& notes) {
    if (!o.leaves && splines.leaves() > 0) {
        notes.push_back(counted(splines.leaves(), "leaf", "leaves") + " left out (--leaves keeps them)");
        splines.leaf_branch.clear();
        splines.leaf_at.clear();
        splines.leaf_position.clear();
        splines.leaf_rotation.clear();
        splines.leaf_length.clear();
        splines.leaf_width.clear();
        splines.leaf_kind.clear();
        splines.leaf_count.clear();
    }
    if (!o.fruit && splines.fruits() > 0) {
        notes.push_back(std::to_string(splines.fruits()) + " fruit left out (--fruit keeps them)");
        splines.fruit_branch.clear();
        splines.fruit_at.clear();
        splines.fruit_position.clear();
        splines.fruit_center.clear();
        splines.fruit_radius.clear();
    }
}

// Asked for, and not there.
void name_missing(const Splines& splines, const GrowthOptions& o, const std::string& file,
                  std::vector<std::string>& notes) {
    constexpr const char* why = ", and none grow on what is imported";
    if (o.leaves && splines.leaves() == 0) notes.push_back("--leaves: " + file + " has no leaves" + why);
    if (o.fruit && splines.fruits() == 0) notes.push_back("--fruit: " + file + " has no fruit" + why);
}

std::string chosen_skeleton(const CommonOptions& common) {
    if (!common.format.empty()) return common.format == "swc" || common.format == "treetools" ? common.format : "";
    const std::string kind = ending(common.output);
    return kind == ".swc" ? "swc" : kind == ".txt" ? "treetools" : "";
}

Splines imported(Options& o) {
    ImportNotes notes;
    Splines splines = read_import(o.import, o.choice, notes, [&o](bool own) {
        if (!own || !chosen_skeleton(o.common).empty()) // splines may be written in their own place
            refuse_overwriting({{"--import", o.import}}, {{"-o", o.common.output}});
    });
    refuse_overwriting_the_model({{"-o", o.common.output}});
    const std::string name = input_name(o.import);
    if (o.stats) std::cerr << import_statistics(splines, notes);
    if (o.strict && !notes.lines.empty()) throw InputError(name, notes.lines.front() + " (--strict)");
    if (!o.stats) // which has told them
        for (const std::string& line : notes.lines) o.common.notes.push_back(name + ": " + line);
    name_missing(splines, o.growth, name, o.common.notes);
    leave_out(splines, o.growth, o.common.notes);
    if (o.growth.radii == "carry") {
        const Material* const named = find_wood(splines.material);
        make_carry(splines, named ? *named : wood_presets().front(), o.common.notes);
    }
    return splines;
}

void write(const Splines& splines, CommonOptions& common) {
    const std::string skeleton = chosen_skeleton(common);
    const Form form = skeleton.empty() ? chosen_form(common) : Form::json;
    Output output(common.output);
    std::vector<std::string> lost;
    if (skeleton == "swc")
        write_swc(output, splines, lost);
    else if (skeleton == "treetools")
        write_treetools(output, splines, lost);
    else
        write_splines(output, splines, form);
    output.finish();
    for (const std::string& line : lost) common.notes.push_back(output.name() + ": " + line);
}

void work(Options& o) {
    if (o.growth.list_species) {
        Output output(o.common.output);
        for (const std::string& name : species_names()) output.write(name + "\n");
        return output.finish();
    }
    refuse_contradictions(o);
    require_outputs({{"-o", o.common.output}});
    Splines splines = o.import.empty() ? grow_tree(o.growth, o.choice, o.common) : imported(o);
    splines.source = with_command_line(splines.source, o.common);
    write(splines, o.common);
}

} // namespace

int main(int argc, char** argv) {
    Options o;
    return run_tool(
        info, argc, argv, o.common, [&o](OptionList& list) { declare(list, o); }, [&o] { work(o); });
}
