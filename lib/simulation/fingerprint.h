// fingerprint.h: which run a saved state belongs to.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"

namespace bough {

// 64 bits (FNV-1a) of all that decides how a run goes on: the joined tree's numbers and the scene's. A part that the scene lacks adds nothing, so
// saved states stay valid when scenes gain new parts. O(bodies + keys). Errors none.
std::uint64_t fingerprint(const Tree& joined, const Scene&);

} // namespace bough
