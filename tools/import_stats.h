// import_stats.h: --stats of the tools that import: what was understood of a file, before anything is made of it.
#pragma once
#include "formats/imports/import.h"
#include "lib/model/tree.h"
#include <string>

namespace bough {

// A line each: format and counts, unit and up axis and where they come from, roots, height, length, radii, then what was
// guessed, repaired or left out. Metres and Y up, of the splines as they are now. O(points).
std::string import_statistics(const Splines&, const ImportNotes&);

// How a tree sways, as it stands drawn under its weight: the first bending mode along x and z, the lowest mode, and which branch buckles
// (study/modes.h); "none: ..." where it cannot stand.
std::string sway_text(const Tree&);

} // namespace bough
