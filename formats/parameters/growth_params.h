// growth_params.h: growth from another program's parameters: Arbaro's XML, friggog tree-gen's and Blender Sapling's
// dicts as JSON or as the Python text itself. Which one a file is, its content decides, then its name.
//
// Lengths are metres, angles degrees in all of them. What a file leaves out takes that program's own default. What
// cannot be honoured, or only nearly, is named in one note each; the table is in formats/parameters/README.md.
#pragma once
#include "lib/growth/growth_parameters.h"
#include "parameter_table.h"
#include <string>
#include <string_view>
#include <vector>

namespace bough {

// [m] Programs that draw pictures let stems end in points; here no radius is less.
constexpr double least_foreign_radius = 1e-4;

struct ParameterNotes {
    std::vector<std::string> differs;      // honoured in another way, with how
    std::vector<std::string> not_honoured; // "NAMES (reason)"
    std::vector<std::string> lines() const;
};

// Throws InputError with the line and what was expected: text of no known kind, an unknown name, a value of the wrong
// kind or out of its range.
GrowthParameters read_growth_parameters(std::string_view content, const std::string& file, ParameterNotes&);

// The readers behind it, one a file.
GrowthParameters read_arbaro(std::string_view content, const std::string& file, ParameterNotes&);
GrowthParameters read_tree_gen(ParameterTable&, ParameterNotes&);
GrowthParameters read_sapling(ParameterTable&, ParameterNotes&);

} // namespace bough
