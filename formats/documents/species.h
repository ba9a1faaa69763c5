// species.h: the species document, "bough-species" (formats/parameters/README.md), and those that come with bough.
#pragma once
#include "formats/open.h"
#include "lib/growth/species.h"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bough {

bool is_species(std::string_view content);
Species read_species(std::string_view content, const std::string& name); // checked; throws InputError

// A document of data/species, compiled in.
struct SpeciesFile {
    std::string_view name, content;
};
const std::vector<SpeciesFile>& species_files(); // by name
// Of this name: the default tree or one of these; nullopt for another.
std::optional<Species> find_species(const std::string& name);

} // namespace bough
