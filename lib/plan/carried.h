// carried.h: what bodies carry and what the air takes hold of, of a checked, scaled tree with no rigid bodies. O(n) each.
#pragma once
#include "../model/tree.h"
#include "plan.h"

namespace bough {

// Plan::drag_area.
template <class T> void plan_surfaces(Plan<T>&, const Tree&);

// [kg m] P_b: first moment that body b's own turning moves, its mass and, at its children's joints, their composites'; body axes. Reads c_mass.
template <class T> std::vector<Vec3> carried_moments(const Plan<T>&, const Tree&);
// [kg] likewise of kappa rho A, as the air resists a body's turning by all that it carries (air.h). Reads drag_area.
template <class T> std::vector<Vec3> carried_drag(const Plan<T>&, const Tree&);

// As an array of the plan's precision.
template <class T> std::vector<Vector3<T>> in_precision(const std::vector<Vec3>& from) {
    std::vector<Vector3<T>> to;
    to.reserve(from.size());
    for (const Vec3& v : from) to.push_back(v.template cast<T>());
    return to;
}

} // namespace bough
