// placed_import.h: an imported tree put where a simulation expects it, and its size looked at.
#pragma once
#include "import.h"

namespace bough {

// A tree whose bases stand more than 10 times its own extent away to the side, or more than once above or below the
// origin (coordinates of a survey), is moved: the middle of its bases, and the lowest of them, to the origin, as wind is
// given over the ground. One note with the way.
void bring_to_origin(Splines&, ImportNotes&);

// A note where the tree is higher than any (120 m) or lower than 0.1 m: the unit is then the likely mistake.
void name_absurd_scale(const Splines&, ImportNotes&);

} // namespace bough
