#include "species.h"
#include "document.h"
#include "lib/model/wood.h"
#include <cmath>
#include <stdexcept>
#include <utility>

namespace bough {
namespace {

constexpr DocumentType species_document{"bough-species", 1};

// One number of every level: an array in the document.
struct LevelColumn {
    const char* name;
    double LevelParameters::*value;
};
constexpr LevelColumn level_columns[] = {
    {"down_angle", &LevelParameters::down_angle},
    {"down_angle_v", &LevelParameters::down_angle_v},
    {"rotate", &LevelParameters::rotate},
    {"rotate_v", &LevelParameters::rotate_v},
    {"branches", &LevelParameters::branches},
    {"base_size", &LevelParameters::base_size},
    {"radius_mod", &LevelParameters::radius_mod},
    {"branch_dist", &LevelParameters::branch_dist},
    {"length", &LevelParameters::length},
    {"length_v", &LevelParameters::length_v},
    {"taper", &LevelParameters::taper},
    {"taper_power", &LevelParameters::taper_power},
    {"seg_splits", &LevelParameters::seg_splits},
    {"split_angle", &LevelParameters::split_angle},
    {"split_angle_v", &LevelParameters::split_angle_v},
    {"base_splits", &LevelParameters::base_splits},
    {"curve", &LevelParameters::curve},
    {"curve_back", &LevelParameters::curve_back},
    {"curve_v", &LevelParameters::curve_v},
    {"attraction_up", &LevelParameters::attraction_up},
    {"bend_v", &LevelParameters::bend_v},
};
constexpr std::size_t columns = std::size(level_columns);

// What the document says in another form than GrowthParameters.
struct Forms {
    std::vector<double> column[columns];
    std::vector<std::int32_t> curve_res;
    std::string rules = "bough";
    std::vector<Vec3> tropism; // none or one
    double leaf_quality = 1;
};

GrowthRules rules_named(const std::string& rules, const std::string& file) {
    if (rules == "bough") return GrowthRules::bough;
    if (rules == "arbaro") return GrowthRules::arbaro;
    if (rules == "tree-gen") return GrowthRules::tree_gen;
    throw InputError(file + ": /rules", "is \"" + rules + "\", expected bough, arbaro or tree-gen");
}

std::vector<Field> fields_of(Species& s, Forms& forms) {
    GrowthParameters& p = s.growth;
    const Per level{"level in /levels", [&p] { return std::size_t(p.levels); }};
    std::vector<Field> fields = {
        {"name", &s.name},
        optional({"source", &s.source}),
        {"material", &s.material},
        optional(array("color", s.color, {})),
        optional(array("season_leaf_color", s.season_leaf_color, {})),
        optional(array("leaf_outline", s.leaf.outline, {})),
        optional({"leaf_veins", &s.leaf.veins}),
        optional({"leaf_petiole", &s.leaf.petiole}),
        optional({"leaf_fold", &s.leaf.fold}),
        optional({"leaf_curl", &s.leaf.curl}),
        optional({"leaf_teeth", &s.leaf.teeth}),
        optional({"leaf_tooth", &s.leaf.tooth}),
        optional({"leaf_needles", &s.leaf.needles}),
        optional({"leaf_spread", &s.leaf.spread}),
        optional({"bark", &s.bark.pattern}),
        optional({"bark_cells", &s.bark.cells}),
        optional({"bark_stretch", &s.bark.stretch}),
        optional({"bark_depth", &s.bark.depth}),
        optional(array("season_leaves", s.season_leaves, {})),
        optional(array("season_petals", s.season_petals, {})),
        optional(array("season_fruit", s.season_fruit, {})),
        optional({"mature_age", &s.mature_age}),
        optional({"height_rate", &s.height_rate}),
        optional({"height_power", &s.height_power}),
        optional({"diameter_power", &s.diameter_power}),
        optional({"branches_power", &s.branches_power}),
        optional({"rules", &forms.rules}),
        {"shape", &p.shape},
        {"levels", &p.levels},
        {"scale", &p.scale},
        optional({"scale_v", &p.scale_v}),
        {"ratio", &p.ratio},
        optional({"ratio_power", &p.ratio_power}),
        optional({"radius_scale", &p.radius_scale}),
        optional({"radius_scale_v", &p.radius_scale_v}),
        optional({"flare", &p.flare}),
        optional({"trunk_spread", &p.trunk_spread}),
        optional(array("tropism", forms.tropism, {})),
        optional({"prune_ratio", &p.prune_ratio}),
        optional({"prune_base", &p.prune_base}),
        optional({"prune_width", &p.prune_width}),
        optional({"prune_width_peak", &p.prune_width_peak}),
        optional({"prune_power_low", &p.prune_power_low}),
        optional({"prune_power_high", &p.prune_power_high}),
        optional({"leaves", &p.leaves}),
        optional({"leaf_quality", &forms.leaf_quality}),
        optional({"leaf_stem", &p.leaf_stem}),
        optional({"leaf_distrib", &p.leaf_distrib}),
        optional(array("leaf_angles", p.leaf_angles, {})),
        optional({"leaf_scale", &p.leaf_scale}),
        optional({"leaf_scale_v", &p.leaf_scale_v}),
        optional({"leaf_scale_x", &p.leaf_scale_x}),
        optional({"leaf_bend", &p.leaf_bend}),
        optional({"blossoms", &p.blossoms}),
        optional({"blossom_rate", &p.blossom_rate}),
        optional({"petals", &p.petals}),
        optional({"petal_scale", &p.petal_scale}),
        optional({"petal_scale_x", &p.petal_scale_x}),
        optional({"fruits", &p.fruits}),
        optional({"fruit_radius", &p.fruit_radius}),
        optional({"fruit_stalk", &p.fruit_stalk}),
        optional({"split_exponent", &p.split_exponent}),
        optional({"crown_top", &p.crown_top}),
        optional({"leading_shoot", &p.leading_shoot}),
        optional({"least_radius", &p.least_radius}),
        optional({"most_slender", &p.most_slender}),
        optional({"pipe_exponent", &p.pipe_exponent}),
        optional({"most_sag", &p.most_sag}),
        array("curve_res", forms.curve_res, level),
    };
    for (std::size_t k = 0; k < columns; ++k)
        fields.push_back(
            array(level_columns[k].name, forms.column[k], level, LevelParameters{}.*level_columns[k].value));
    return fields;
}

} // namespace

bool is_species(std::string_view content) {
    return document_format(content) == species_document.format;
}

Species read_species(std::string_view content, const std::string& name) {
    Species s;
    Forms forms;
    read_document(content, name, species_document, fields_of(s, forms));
    s.growth.rules = rules_named(forms.rules, name);
    if (forms.tropism.size() > 1) throw InputError(name + ": /tropism", "holds several vectors, expected one");
    if (!forms.tropism.empty()) s.growth.tropism = forms.tropism.front();
    if (!(forms.leaf_quality > 0 && forms.leaf_quality <= 1))
        throw InputError(name + ": /leaf_quality", "is out of range, expected more than 0 and at most 1");
    s.growth.leaves *= forms.leaf_quality;
    s.growth.leaf_scale /= std::sqrt(forms.leaf_quality);
    s.growth.leaf_scale_v /= std::sqrt(forms.leaf_quality);
    if (s.growth.levels < 1 || s.growth.levels > 4)
        throw InputError(name + ": /levels", "is " + std::to_string(s.growth.levels) + ", expected 1 to 4");
    for (std::size_t n = 0; n < std::size_t(s.growth.levels); ++n) {
        for (std::size_t k = 0; k < columns; ++k)
            if (!forms.column[k].empty()) s.growth.level[n].*level_columns[k].value = forms.column[k][n];
        s.growth.level[n].curve_res = forms.curve_res[n];
    }
    // The next level's angles, which the paper takes, are not in a document of `levels` levels.
    if (s.growth.leaves != 0 && s.growth.leaf_angles.empty())
        throw InputError(name + ": /leaf_angles", "is missing, expected four angles, as the tree has leaves");
    s.growth.name = s.name;
    const Material* wood = find_wood(s.material);
    if (!wood)
        throw InputError(name + ": /material",
                         "is \"" + s.material + "\", expected one of treeconvert --list-materials");
    s.growth.wood = *wood;
    try {
        check_species(s);
    } catch (const std::invalid_argument& error) {
        throw InputError(name, error.what());
    }
    return s;
}

std::optional<Species> find_species(const std::string& name) {
    if (name == default_species().name) return default_species();
    for (const SpeciesFile& file : species_files())
        if (file.name == name) return read_species(file.content, name);
    return std::nullopt;
}

} // namespace bough
