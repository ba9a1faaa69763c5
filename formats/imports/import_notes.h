// import_notes.h: what the reading of another program's tree tells beside the tree.
#pragma once
#include "lib/base/math.h"
#include <string>
#include <vector>

namespace bough {

// What a reader wants the user to know: guesses made (units, up) with the reason, things left out, with counts.
struct ImportNotes {
    std::vector<std::string> lines;
    // What was understood, for --stats.
    std::string format;               // name of the format
    double unit = 1;                  // [m] one unit of the file
    char up = 'y';                    // its up axis, 'y' or 'z'
    Vec3 moved = Vec3::Zero();        // [m] by which it was moved to the origin (placed_import.h), Y up
    std::string unit_from = "stated"; // "stated" by the file or its format, "given" as option, or "guessed"
    std::string up_from = "stated";
    bool odd_radius_told = false; // by a reader that knows its line (placed_import.h)
    bool radii_guessed = false;   // all of them, by the tree's size: the file has none
};

} // namespace bough
