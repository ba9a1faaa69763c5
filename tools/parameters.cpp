#include "parameters.h"
#include "formats/eztree.h"
#include "formats/growth_params.h"
#include "formats/species.h"
#include "lib/growth/carry.h"
#include "lib/model/wood.h"

namespace bough {

std::variant<Species, EzTreeParameters> read_parameter_file(const std::string& path, CommonOptions& common) {
    const std::string content = read_input(path), name = input_name(path);
    if (is_species(content)) return read_species(content, name);
    std::vector<std::string> lines;
    std::variant<Species, EzTreeParameters> result;
    if (is_eztree(content))
        result = read_eztree(content, name, lines);
    else {
        ParameterNotes notes;
        Species species = default_species();
        species.growth = read_growth_parameters(content, name, notes);
        species.name = species.growth.name;
        lines = notes.lines();
        result = species;
    }
    for (const std::string& line : lines) common.notes.push_back(name + ": " + line);
    return result;
}

void note_sagging(const Splines& splines, const std::string& material, CommonOptions& common) {
    constexpr double most_sag = 0.5; // [rad]
    const Material* wood = find_wood(material);
    Splines carried = splines;
    thicken_to_carry(carried, wood ? *wood : wood_presets().front(), most_sag);
    std::size_t weak = 0;
    for (std::size_t b = 0; b < splines.branches(); ++b) {
        bool raised = false;
        for (auto i = splines.first_point[b]; i < splines.first_point[b + 1]; ++i)
            raised = raised || carried.radius[std::size_t(i)] > 1.01 * splines.radius[std::size_t(i)];
        weak += raised;
    }
    if (weak > 0)
        common.notes.push_back(std::to_string(weak) + " of " + std::to_string(splines.branches()) +
                               " branches are thinner than wood must be to carry what is on them without bending by "
                               "half a radian");
}

} // namespace bough
