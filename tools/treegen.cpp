// treegen: a tree as splines, grown from parameters or imported from another program's file.
#include "common.h"
#include "envelope.h"
#include "formats/import.h"
#include "formats/species.h"
#include "formats/splines.h"
#include "parameters.h"
#include <algorithm>
#include <iostream>

namespace {

using namespace bough;

struct Options {
    CommonOptions common;
    ImportChoice choice;
    std::string species, params, import;
    EnvelopeOptions envelope;
    std::optional<std::int64_t> bodies;
    std::optional<std::uint64_t> seed;
    std::optional<double> age;
    std::string season;
    bool leaves = false, petals = false, fruit = false, list_species = false;
};

// What --species takes: the default tree and the documents that come with bough.
std::vector<std::string> species_names() {
    std::vector<std::string> names = {default_species().name};
    for (const SpeciesFile& file : species_files()) names.emplace_back(file.name);
    return names;
}

const std::vector<std::string> season_names = {"spring", "summer", "autumn", "winter"};

const ToolInfo info = {
    "treegen",
    "Makes a tree as splines: grown by Weber and Penn's recursion, grown into a volume (--envelope), or imported.\n"
    "Usage: treegen [--species NAME] [--age YEARS] [--season NAME] [--bodies N] [--seed N] [--leaves] [--petals] "
    "[--fruit]\n"
    "       treegen --params FILE [--bodies N] [--seed N] [--leaves] [--petals] [-o FILE]\n"
    "       treegen --envelope sphere|cone|box|FILE [--envelope-size X,Y,Z] [--attractors N] ... [-o FILE]\n"
    "       treegen --import FILE [--units UNIT] [--up AXIS] [--leaves] [--fruit] [-o FILE]",
    "Imports SpeedTree raw XML (with Spine, or bones only), treetools tree files, SWC, and bough splines; which "
    "one a\n"
    "file is, its content decides. The result goes to treeconvert:\n"
    "  treegen --bodies 2000 --seed 7 | treeconvert - -o tree.json\n"
    "Exit: 0 done, 1 usage, 2 bad input, 4 output not written, 130 interrupted.",
    {"json", "safetensors"}};

void declare(CLI::App& app, Options& o) {
    app.add_option("--species", o.species, "Which tree to grow (see --list-species)")
        ->option_text("NAME")
        ->check(CLI::IsMember(species_names()));
    app.add_option("--params", o.params,
                   "Grow by this file's parameters: Arbaro XML, tree-gen, Blender Sapling, ez-tree, or a "
                   "bough-species document; "
                   "- for stdin")
        ->option_text("FILE");
    app.add_flag("--list-species", o.list_species, "Print the names that --species takes, and exit");
    app.add_option("--import", o.import, "Import this file instead of growing; - for stdin")->option_text("FILE");
    app.add_option("--bodies", o.bodies,
                   "Grow a tree that treeconvert makes N bodies of by default (within 10 %; leaves and fruit count)")
        ->option_text("N")
        ->check(whole_number(1));
    app.add_option("--age", o.age, "Years; the mature tree unless given")
        ->option_text("YEARS")
        ->check(positive_number());
    app.add_option(
           "--season", o.season,
           "spring, summer, autumn or winter: leaves, petals and fruit as the species then has them, and leaves'\n"
           "colour; with --leaves, --petals, --fruit only those asked for")
        ->option_text("NAME")
        ->check(CLI::IsMember(season_names));
    app.add_flag("--leaves", o.leaves, "With leaves or needles; else none unless --season");
    app.add_flag("--petals", o.petals, "With blossoms");
    app.add_flag("--fruit", o.fruit, "With fruit");
    app.add_option("--seed", o.seed, "Seed of every random draw (0)")->option_text("N")->check(whole_number(0));
    add_import_options(app, o.choice);
    add_envelope_options(app, o.envelope);
}

void refuse_contradictions(const Options& o) {
    if (!o.params.empty() && !o.species.empty())
        throw UsageError("--species: not with --params, which is another tree");
    if (!o.envelope.envelope.empty()) {
        if (!o.import.empty()) throw UsageError("--envelope: not with --import");
        if (!o.species.empty()) throw UsageError("--envelope: not with --species, which grows in its own way");
        if (!o.params.empty()) throw UsageError("--envelope: not with --params, which grow in their own way");
        if (o.age) throw UsageError("--age: not with --envelope, whose size says how big the tree is");
        if (!o.season.empty()) throw UsageError("--season: not with --envelope, which has no species");
        if (o.petals) throw UsageError("--petals: not with --envelope, which has no species");
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
    if (!o.params.empty()) throw UsageError(std::string("--params") + reason);
    if (o.bodies) throw UsageError(std::string("--bodies") + reason);
    if (o.age) throw UsageError(std::string("--age") + reason);
    if (!o.season.empty()) throw UsageError(std::string("--season") + reason);
    if (o.petals) throw UsageError(std::string("--petals") + reason);
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

Splines grown_by_eztree(Options& o, EzTreeParameters preset) {
    if (o.bodies) throw UsageError("--bodies: not with an ez-tree preset, whose numbers are its own");
    if (o.petals) o.common.notes.push_back(preset.name + " has no petals");
    if (o.fruit) o.common.notes.push_back(preset.name + " has no fruit");
    if (o.seed) preset.seed = std::int64_t(*o.seed);
    return grow_eztree(preset, o.leaves);
}

Species chosen_species(const Options& o) {
    for (const SpeciesFile& file : species_files())
        if (file.name == o.species) return read_species(file.content, o.species);
    return default_species();
}

Splines grown(Options& o) {
    const std::uint64_t seed = o.seed.value_or(0);
    if (!o.envelope.envelope.empty())
        return grow_in_envelope(o.envelope, o.choice, {seed, o.bodies, o.leaves, o.fruit}, o.common);
    std::variant<Species, EzTreeParameters> chosen;
    if (o.params.empty())
        chosen = chosen_species(o);
    else
        chosen = read_parameter_file(o.params, o.common);
    const auto* preset = std::get_if<EzTreeParameters>(&chosen);
    const bool foreign = preset || std::get<Species>(chosen).growth.rules != GrowthRules::bough;
    if (foreign && o.age) throw UsageError("--age: not with the parameters of another program, which know of none");
    if (foreign && !o.season.empty())
        throw UsageError("--season: not with the parameters of another program, which know of none");
    const Species species = preset ? default_species() : std::get<Species>(chosen);
    Items items{o.leaves, o.petals, o.fruit};
    if (!o.season.empty() && !o.leaves && !o.petals && !o.fruit) items = {true, true, true};
    try {
        if (preset) {
            Splines splines = grown_by_eztree(o, *preset);
            note_sagging(splines, splines.material, o.common);
            return splines;
        }
        GrowthParameters growth = o.age ? at_age(species, *o.age) : species.growth;
        std::vector<Vec3> color = species.color;
        if (!o.season.empty()) {
            const auto season =
                Season(std::find(season_names.begin(), season_names.end(), o.season) - season_names.begin());
            growth = in_season(species, growth, season);
            color = colors_in_season(species, season);
        }
        const auto note_none = [&](bool wanted, double number, const char* what) {
            if (wanted && number == 0)
                o.common.notes.push_back(species.name + " has no " + what +
                                         (o.season.empty() ? "" : " in " + o.season));
        };
        note_none(o.leaves, growth.leaves, "leaves");
        note_none(o.petals, growth.blossoms + growth.blossom_rate, "petals");
        note_none(o.fruit, growth.fruits, "fruit");
        Splines splines = o.bodies ? grow_bodies(growth, seed, items, *o.bodies) : grow(growth, seed, items);
        if (foreign) note_sagging(splines, species.material, o.common);
        splines.material = species.material;
        splines.color = color;
        return splines;
    } catch (const std::invalid_argument& error) {
        if (!o.params.empty() && !o.bodies) throw InputError(input_name(o.params), error.what());
        throw UsageError(error.what());
    }
}

void work(Options& o) {
    if (o.list_species) {
        for (const std::string& name : species_names()) std::cout << name << "\n";
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
