// carried.h: what bodies carry and what the air takes hold of, for a checked, scaled tree with no rigid bodies. O(n) each.
#pragma once
#include "../model/tree.h"
#include "plan.h"

namespace bough {

// Fills in Plan::kind, drag_area and facing.
template <class T> void plan_surfaces(Plan<T>&, const Tree&);

// [kg m] Returns P_b: the first moment that body b's own turning moves: of its mass and, at its children's joints, their composites. Body axes. Reads
// c_mass.
template <class T> std::vector<Vec3> carried_moments(const Plan<T>&, const Tree&);
// [kg] Returns the same of kappa rho A: the air resists a body's turning through all that the body carries (air.h). Reads drag_area.
template <class T> std::vector<Vec3> carried_drag(const Plan<T>&, const Tree&);

// Returns the vectors in the plan's precision.
template <class T> std::vector<Vector3<T>> in_precision(const std::vector<Vec3>& from) {
    std::vector<Vector3<T>> to;
    to.reserve(from.size());
    for (const Vec3& v : from) to.push_back(v.template cast<T>());
    return to;
}

} // namespace bough
