// material.h: the user's own wood, "bough-material", a small JSON file:
//
//   {"format": "bough-material", "version": 1, "like": "black-willow", "name": "my willow", "youngs_modulus": 4.9e9}
//
// Every number of struct Material (lib/model/wood.h) may be given under its own name and unit; one that is left out is
// that of the preset named in "like", by default the default preset. "name" and "source" are optional text; without
// them the material is called after the file, and its source is "like" and the preset's. Unknown and repeated fields,
// numbers out of range (check(Material)) and a newer version are errors that name the place.
#pragma once
#include "formats/open.h"
#include "lib/model/wood.h"

namespace bough {

Material read_material(std::string_view content, const std::string& name); // checked; throws InputError

} // namespace bough
