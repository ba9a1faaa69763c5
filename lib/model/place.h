// place.h: where a tree stands in the world.
#pragma once
#include "tree.h"

namespace bough {

// Turns the tree by yaw [rad] about +Y through the world's origin, then moves it by position [m], in place. Only roots are placed in the world; every
// other body hangs in its parent's frame and comes along. The bodies from `first` on are placed. O(bodies from `first` on).
void place(Tree&, const Vec3& position, double yaw, std::size_t first = 0);

} // namespace bough
