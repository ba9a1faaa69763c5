// bodies.h: the geometry of segment.h's bodies: frustums on the curves' cuts, leaves and fruit on the pieces that bear
// them. Mass, stiffness and damping are the material's (stiffness.h).
//
// A frustum goes straight from joint to joint; its radii are the curve's at these two arc lengths. Its frame has z
// along it, turned the least from the piece before; a branch's first piece from the piece that bears it; a trunk's from
// the frame with x along the world's X and z up. A fruit's frame likewise, z to its centre. A leaf's frame is its own.
// Whatever hangs sideways belongs to the piece that holds its arc length on the parent (at a cut, the one that begins
// there); its joint stays where it was drawn.
// A leaf that stands for several is one body with its count (leaf_count.h).
// Writes every array but mass, com, inertia, stiffness, damping. O(points + bodies log points).
#pragma once
#include "../model/tree.h"
#include "../model/wood.h"
#include "cut.h"

namespace bough {

Tree make_bodies(const Splines&, const Curves&, const CutRule&, const Material&);

} // namespace bough
