// import_stats.h: --stats of the tools that import: what was understood of a file, before anything is made of it.
#pragma once
#include "formats/imports/import.h"
#include <string>

namespace bough {

// A line each: format and counts, unit and up axis and where they come from, roots, height, length, radii, then what was
// guessed, repaired or left out. Metres and Y up, of the splines as they are now. O(points).
std::string import_statistics(const Splines&, const ImportNotes&);

} // namespace bough
