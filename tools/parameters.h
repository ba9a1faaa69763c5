// parameters.h: treegen --params: the growth that a file of parameters describes, whichever program it is of.
#pragma once
#include "common.h"
#include "lib/growth/eztree.h"
#include "lib/growth/species.h"
#include <variant>

namespace bough {

// Our own species document, other programs' parameters of Weber and Penn's growth as a species of the default wood, or
// an ez-tree preset. What cannot be honoured is added to the notes. Throws InputError.
std::variant<Species, EzTreeParameters> read_parameter_file(const std::string& path, CommonOptions&);

// Adds a note on how many branches of a tree made for pictures would not hold their shape as wood.
void note_sagging(const Splines&, const std::string& material, CommonOptions&);

} // namespace bough
