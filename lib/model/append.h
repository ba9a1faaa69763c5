// append.h: several trees in one.
#pragma once
#include "tree.h"

namespace bough {

// Appends `more` to `tree`, turned by yaw [rad] about +Y and moved by position [m]. A scene stands several trees in one world this way. Branch
// numbers of `more` are shifted behind those present. Name, material, source and colours stay those of the first tree. Returns the first body's
// index.
std::size_t append(Tree& tree, const Tree& more, const Vec3& position, double yaw);

} // namespace bough
