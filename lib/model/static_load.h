// static_load.h: what lies on the trees (StaticLoad, scene.h; §11 of the paper): snow, or the water that rain leaves.
//
// A body carries kg/m^2 of its kind times the area that it shows from above, +Y, in the drawn pose:
//   branch       2 r l sin(angle between its axis and the vertical), r the mean of both ends' radii; its end caps left out
//   leaf, petal  A |n.y|, A the triangle's area, n its normal (the body's y)
//   clump        A (1 + f) / 2, A of its leaves, f its leaf_facing: |m_y| of those that face up is 1, in the mean of those that face all ways 1/2
//   fruit        pi r^2
// The load lies along the body as the body's own mass does: the mass grows by it, the inertia grows in the same ratio, and the centre of mass stays.
// The load is put on once: what falls off as the body turns, and what one body keeps from another below it, is left out. A start pose then takes the
// load into account (pose.h): the drawn tree is in equilibrium without it, and the run starts from the sag with it.
// Reads   a joined, checked tree and a checked load. Writes mass, inertia, load (added to what lies there). It runs before any plan is made of the
//         tree; the caller then resets the scene's load, which make_plan refuses.
// Cost    O(bodies). Errors none.
#pragma once
#include "scene.h"

namespace bough {

struct LoadLaid {
    double mass = 0;        // [kg] in all
    std::size_t bodies = 0; // that carry some of it
};
LoadLaid lay_load(Tree& joined, const StaticLoad&);

// [m^2] Returns the area from above of body i, R_wb its frame (world from body).
double area_from_above(const Tree&, std::size_t i, const Mat3& R_wb);

} // namespace bough
