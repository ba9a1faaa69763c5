// lop.h: branches left out of a tree that has too many of them.
#pragma once
#include "../model/splines.h"
#include <cstdint>

namespace bough {

// The tree without `count` of its childless branches of the deepest levels and what grows on them, chosen by the seed; what
// they grew on may be chosen in turn. The trunk stays. O(points + branches log branches).
Splines without_twigs(const Splines&, std::uint64_t seed, std::int64_t count);

} // namespace bough
