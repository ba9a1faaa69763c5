#include "parameters.h"
#include "formats/documents/species.h"
#include "formats/parameters/eztree.h"
#include "formats/parameters/growth_params.h"

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

} // namespace bough
