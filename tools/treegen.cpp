// treegen: a tree as splines, grown from parameters or imported from another program's file.
#include "common.h"
#include "envelope.h"
#include "formats/import.h"
#include "formats/splines.h"
#include "lib/growth/grow.h"
#include <iostream>

namespace {

using namespace bough;

struct Options {
    CommonOptions common;
    ImportChoice choice;
    EnvelopeOptions envelope;
    std::string species, import;
    std::optional<std::int64_t> bodies;
    std::optional<std::uint64_t> seed;
    bool leaves = false, fruit = false, list_species = false;
};

// What --species takes. One parameter set so far; a name is only listed once the tree behind it exists.
const std::vector<std::string> species_names = {"broadleaf"};

const ToolInfo info = {
    "treegen",
    "Makes a tree as splines: grown by Weber and Penn's recursion, grown into a volume (--envelope), or imported.\n"
    "Usage: treegen [--species NAME] [--bodies N] [--seed N] [--leaves] [--fruit] [-o FILE]\n"
    "       treegen --envelope sphere|cone|box|FILE [--envelope-size X,Y,Z] [--attractors N] ... [-o FILE]\n"
    "       treegen --import FILE [--units UNIT] [--up AXIS] [--leaves] [--fruit] [-o FILE]",
    "Imports SpeedTree raw XML (with Spine, or bones only), treetools tree files, SWC, and bough splines; which one a\n"
    "file is, its content decides. The result goes to treeconvert:\n"
    "  treegen --bodies 2000 --seed 7 | treeconvert - -o tree.json\n"
    "Exit: 0 done, 1 usage, 2 bad input, 4 output not written, 130 interrupted.",
    {"json", "safetensors"}};

void declare(CLI::App& app, Options& o) {
    app.add_option("--species", o.species, "Which tree to grow (see --list-species)")
        ->option_text("NAME")
        ->check(CLI::IsMember(species_names));
    app.add_flag("--list-species", o.list_species, "Print the names that --species takes, and exit");
    app.add_option("--import", o.import, "Import this file instead of growing; - for stdin")->option_text("FILE");
    app.add_option("--bodies", o.bodies,
                   "Grow a tree that treeconvert makes N bodies of by default (within 10 %; leaves and fruit count)")
        ->option_text("N")
        ->check(whole_number(1));
    app.add_flag("--leaves", o.leaves, "With leaves; else none");
    app.add_flag("--fruit", o.fruit, "With fruit; else none");
    app.add_option("--seed", o.seed, "Seed of every random draw (0)")->option_text("N")->check(whole_number(0));
    add_import_options(app, o.choice);
    add_envelope_options(app, o.envelope);
}

void refuse_contradictions(const Options& o) {
    if (!o.envelope.envelope.empty()) {
        if (!o.import.empty()) throw UsageError("--envelope: not with --import");
        if (!o.species.empty()) throw UsageError("--envelope: not with --species, which grows in its own way");
        return;
    }
    for (const auto& [option, given] : o.envelope.given())
        if (given) throw UsageError(option + ": only with --envelope");
    if (o.import.empty()) {
        if (!o.choice.units.empty()) throw UsageError("--units: only with --import or --envelope FILE");
        if (!o.choice.up.empty()) throw UsageError("--up: only with --import or --envelope FILE");
        return;
    }
    const char* reason = ": not with --import, whose file says what the tree is";
    if (!o.species.empty()) throw UsageError(std::string("--species") + reason);
    if (o.bodies) throw UsageError(std::string("--bodies") + reason);
    if (o.seed) throw UsageError(std::string("--seed") + reason);
}

// Leaves and fruit come only when asked for, from a file as from growth; what was left out is said.
void leave_out(Splines& splines, const Options& o, std::vector<std::string>& notes) {
    if (!o.leaves && splines.leaves() > 0) {
        notes.push_back(std::to_string(splines.leaves()) + " leaves left out (--leaves keeps them)");
        splines.leaf_branch.clear();
        splines.leaf_at.clear();
        splines.leaf_position.clear();
        splines.leaf_rotation.clear();
        splines.leaf_length.clear();
        splines.leaf_width.clear();
        splines.leaf_kind.clear();
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

Splines imported(Options& o) {
    const std::string content = read_input(o.import);
    if (is_splines(content) && !(o.choice.units.empty() && o.choice.up.empty()))
        throw UsageError(std::string(o.choice.units.empty() ? "--up" : "--units") + ": " + input_name(o.import) +
                         " is a bough document, which is in metres and Y up");
    ImportOptions options;
    options.unit = unit_in_metres(o.choice.units);
    if (!o.choice.up.empty()) options.up = char(std::tolower(o.choice.up[0]));
    options.name = input_name(o.import);
    ImportNotes notes;
    Splines splines = import_splines(content, options, notes);
    for (const std::string& line : notes.lines) o.common.notes.push_back(options.name + ": " + line);
    leave_out(splines, o, o.common.notes);
    return splines;
}

Splines grown(Options& o) {
    const std::uint64_t seed = o.seed.value_or(0);
    if (!o.envelope.envelope.empty())
        return grow_in_envelope(o.envelope, o.choice, {seed, o.bodies, o.leaves, o.fruit}, o.common);
    try {
        return o.bodies ? grow_bodies(default_growth(), seed, {o.leaves, false, o.fruit}, *o.bodies)
                        : grow(default_growth(), seed, {o.leaves, false, o.fruit});
    } catch (const std::invalid_argument& error) {
        throw UsageError(error.what());
    }
}

void work(Options& o) {
    if (o.list_species) {
        for (const std::string& name : species_names) std::cout << name << "\n";
        return;
    }
    refuse_contradictions(o);
    Splines splines = o.import.empty() ? grown(o) : imported(o);
    splines.source = with_command_line(splines.source, o.common);
    Output output(o.common.output);
    write_splines(output, splines, chosen_form(o.common));
    output.finish();
}

} // namespace

int main(int argc, char** argv) {
    Options o;
    return run_tool(
        info, argc, argv, o.common, [&o](CLI::App& app) { declare(app, o); }, [&o] { work(o); });
}
