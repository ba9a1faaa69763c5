#include "growth.h"
#include "formats/documents/species.h"
#include "formats/files.h"
#include "lib/growth/carry.h"
#include "lib/growth/segment.h"
#include "parameters.h"
#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace bough {
namespace {

const std::vector<std::string> season_names = {"spring", "summer", "autumn", "winter"};

// --species takes known names alone.
Species chosen_species(const GrowthOptions& o) {
    return find_species(o.species).value_or(default_species());
}

Items chosen_items(const GrowthOptions& o) {
    if (!o.season.empty() && !o.leaves && !o.petals && !o.fruit) return {true, true, true};
    return {o.leaves, o.petals, o.fruit};
}

// What wood makes of a tree that was drawn for pictures, said in one line.
std::string raised(std::size_t branches, std::size_t all) {
    return std::to_string(branches) + " of " + std::to_string(all) +
           " branches made thicker than the file says, as wood must be to carry them (--radii file keeps its radii)";
}

Splines grow_preset(const GrowthOptions& o, const ImportChoice& choice, EzTreeParameters preset,
                    CommonOptions& common) {
    if (o.petals) common.notes.push_back(preset.name + " has no petals");
    if (o.fruit) common.notes.push_back(preset.name + " has no fruit");
    if (const auto unit = unit_in_metres(choice.units))
        preset.unit = *unit;
    else
        common.notes.push_back(preset.name + ": one unit taken as 1 m, as ez-tree has none (--units)");
    if (o.seed) preset.seed = std::int64_t(*o.seed);
    Splines splines = grow_eztree(preset, o.leaves);
    if (o.radii == "file") return splines;
    if (const std::size_t count = thicken_to_carry(splines, wood_presets().front(), foreign_sag))
        common.notes.push_back(raised(count, splines.branches()));
    return splines;
}

void note_what_is_not_borne(const GrowthOptions& o, const Species& species, const GrowthParameters& growth,
                            CommonOptions& common) {
    const auto note = [&](bool wanted, double number, const char* what) {
        if (wanted && number == 0)
            common.notes.push_back(species.name + " has no " + what + (o.season.empty() ? "" : " in " + o.season));
    };
    note(o.leaves, growth.leaves, "leaves");
    note(o.petals, growth.blossoms + growth.blossom_rate, "petals");
    note(o.fruit, growth.fruits, "fruit");
}

GrowthParameters growth_at_age(const GrowthOptions& o, const Species& species) {
    try {
        return o.age ? at_age(species, *o.age) : species.growth;
    } catch (const std::invalid_argument& error) {
        throw UsageError("--" + std::string(error.what()));
    }
}

Splines grow_species(const GrowthOptions& o, const Species& species, CommonOptions& common) {
    const bool foreign = species.growth.rules != GrowthRules::bough;
    GrowthParameters growth = growth_at_age(o, species);
    std::vector<Vec3> color = species.color;
    if (!o.season.empty()) {
        const auto season =
            Season(std::find(season_names.begin(), season_names.end(), o.season) - season_names.begin());
        growth = in_season(species, growth, season);
        color = colors_in_season(species, season);
    }
    note_what_is_not_borne(o, species, growth, common);
    if (foreign && o.radii != "file") {
        growth.most_sag = foreign_sag;
        common.notes.push_back(
            "branches are made thicker where wood must be to carry them (--radii file keeps the file's radii)");
    }
    Splines splines = grow(growth, o.seed.value_or(0), chosen_items(o));
    splines.material = species.material;
    splines.color = color;
    return splines;
}

void refuse_what_is_foreign(const GrowthOptions& o, const ImportChoice& choice, bool foreign, bool unitless) {
    if (!unitless && !choice.units.empty())
        throw UsageError("--units: only with --import, --envelope FILE or the preset of ez-tree, which has none");
    const char* reason = ": not with the parameters of another program, which know of none";
    if (foreign && o.age) throw UsageError(std::string("--age") + reason);
    if (foreign && !o.season.empty()) throw UsageError(std::string("--season") + reason);
    if (!foreign && !o.radii.empty())
        throw UsageError(
            "--radii: only with --params of another program or --import; a species says itself what its radii carry");
}

} // namespace

void add_growth_options(OptionList& list, GrowthOptions& o) {
    list.group("Growth");
    list.add("--species", o.species, "Which tree to grow (see --list-species)").takes("NAME").one_of(species_names());
    list.add_flag("--list-species", o.list_species, "Write the names that --species takes, and exit");
    list.add("--params", o.params,
             "Grow by this file's parameters: Arbaro XML, tree-gen, Blender Sapling, ez-tree, or a bough-species\n"
             "document; - for stdin")
        .takes("FILE");
    list.add(
            "--radii", o.radii,
            "carry, thicker than the file says where wood must be to carry the tree (default with --params of another\n"
            "program), or file, as it says (default with --import)")
        .takes("carry|file")
        .one_of({"carry", "file"});
    list.add("--bodies", o.bodies,
             "How many bodies treeconvert makes of the tree by default (within 10 %; leaves and fruit count): the\n"
             "same tree, more or less finely resolved")
        .takes("N")
        .check(whole_number(1));
    list.add("--age", o.age, "Years; the mature tree unless given").takes("YEARS").check(positive_number());
    list.add("--season", o.season,
             "spring, summer, autumn or winter: leaves, petals and fruit as the species then has them, and leaves'\n"
             "colour; with --leaves, --petals, --fruit only those asked for")
        .takes("NAME")
        .one_of(season_names);
    list.add_flag("--leaves", o.leaves, "With leaves or needles; else none unless --season");
    list.add_flag("--petals", o.petals, "With blossoms");
    list.add_flag("--fruit", o.fruit, "With fruit");
    list.add("--seed", o.seed, "Seed of every random draw (0)").takes("N").check(whole_number(0));
    add_envelope_options(list, o.envelope);
}

void refuse_contradictions(const GrowthOptions& o, bool import) {
    const std::pair<std::string_view, bool> given[] = {{"--envelope", !o.envelope.envelope.empty()},
                                                       {"--species", !o.species.empty()},
                                                       {"--params", !o.params.empty()},
                                                       {"--radii", !o.radii.empty()},
                                                       {"--age", o.age.has_value()},
                                                       {"--season", !o.season.empty()},
                                                       {"--petals", o.petals},
                                                       {"--bodies", o.bodies.has_value()},
                                                       {"--seed", o.seed.has_value()}};
    const auto refuse = [&](std::initializer_list<std::string_view> options, const std::string& reason) {
        for (const auto& [option, is_given] : given)
            if (is_given && std::find(options.begin(), options.end(), option) != options.end())
                throw UsageError(std::string(option) + reason);
    };
    const bool envelope = !o.envelope.envelope.empty(), params = !o.params.empty();
    if (import)
        refuse({"--envelope", "--species", "--params", "--age", "--season", "--petals", "--bodies", "--seed"},
               ": not with --import, whose file says what the tree is");
    if (envelope)
        refuse({"--species", "--params", "--radii", "--age", "--season", "--petals"},
               ": not with --envelope, which has no species and grows in its own way");
    if (params) refuse({"--species"}, ": not with --params, which is another tree");
    if (!params && !import) refuse({"--radii"}, ": only with --params or --import");
    if (envelope) return;
    for (const auto& [option, is_given] : o.envelope.given())
        if (is_given) throw UsageError(option + ": only with --envelope");
}

namespace {

Splines grow_whole(const GrowthOptions& o, const ImportChoice& choice, CommonOptions& common) {
    if (!o.envelope.envelope.empty())
        return grow_in_envelope(o.envelope, choice, {o.seed.value_or(0), o.leaves, o.fruit}, common);
    std::variant<Species, EzTreeParameters> chosen;
    if (o.params.empty())
        chosen = chosen_species(o);
    else
        chosen = read_parameter_file(o.params, common);
    const auto* preset = std::get_if<EzTreeParameters>(&chosen);
    refuse_what_is_foreign(o, choice, preset || std::get<Species>(chosen).growth.rules != GrowthRules::bough, preset);
    try {
        return preset ? grow_preset(o, choice, *preset, common) : grow_species(o, std::get<Species>(chosen), common);
    } catch (const std::invalid_argument& error) {
        if (!o.params.empty()) throw InputError(input_name(o.params), error.what());
        throw UsageError(error.what());
    }
}

} // namespace

Splines grow_tree(const GrowthOptions& o, const ImportChoice& choice, CommonOptions& common) {
    Splines splines = grow_whole(o, choice, common);
    try {
        if (o.bodies) ask_for_bodies(splines, *o.bodies);
    } catch (const std::invalid_argument& error) {
        throw UsageError("--" + std::string(error.what()));
    }
    return splines;
}

} // namespace bough
