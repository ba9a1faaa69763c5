// place.h: where a tree stands in the world.
#pragma once
#include "tree.h"

namespace bough {

// Turns the tree by yaw [rad] about +Y through the world's origin, then moves it by position [m], in place. Only roots are placed in the world; every
// other body hangs in its parent's frame and comes along. The bodies from `first` on are placed. O(bodies from `first` on).
void place(Tree&, const Vec3& position, double yaw, std::size_t first = 0);

// Appends `more` to `tree`, turned by yaw [rad] about +Y and moved by position [m]. A scene stands several trees in one world this way. Branch
// numbers of `more` are shifted behind those present. Name, material, source and colours stay those of the first tree. Returns the first body's
// index.
std::size_t append(Tree& tree, const Tree& more, const Vec3& position, double yaw);

} // namespace bough
