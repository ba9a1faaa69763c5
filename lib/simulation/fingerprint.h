// fingerprint.h: which run a saved state belongs to.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"

namespace bough {

// 64 bits (FNV-1a) of all that decides how a run goes on: the joined tree's numbers and the scene's. What a scene lacks adds nothing, so
// that states outlive new parts. O(bodies + keys). Errors none.
std::uint64_t fingerprint(const Tree& joined, const Scene&);

} // namespace bough
