// colony.h: what a colony is made into (colonize.h), step by step. Private to growth and its tests.
#pragma once
#include "colonize.h"

namespace bough {

// The nodes as branches of points, with neither radii nor foliage: levels by the child that goes on, smoothed (where that
// would move a node of the crown out of the envelope, it stays), thinned. Reads of the parameters envelope and step.
Splines trace_branches(const Colony&, const ColonizeParameters&);

// Leaves and fruit on the last `leafy` of each branch, whose radii stand.
void add_colony_foliage(const ColonizeParameters&, std::uint64_t seed, bool with_leaves, bool with_fruit, Splines&);

} // namespace bough
