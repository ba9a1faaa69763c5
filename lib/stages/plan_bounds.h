// plan_bounds.h: what a plan knows of its tree beforehand so that steps of any size stay bounded: drag's surfaces and bounds (drag.h), the analytic
// solver's factors of inertia (branch_mode.h) and bounds of gravity's rows, the coupled one's first moments of mass and drag. Each fills the arrays of the plan
// that bear its name, from a checked, scaled tree with no rigid bodies. O(n) each.
#pragma once
#include "../model/tree.h"
#include "plan.h"

namespace bough {

// drag_area
template <class T> void plan_surfaces(Plan<T>&, const Tree&, const Scene&);
// inertia_factor, and with a wind drag's bounds: sway, joint_distance, com_distance, inverse_weight. Returns the weights by which gravity
// and drag are summed along a path.
template <class T> std::vector<double> plan_modes(Plan<T>&, const Tree&);
// row_gravity, gravity_row: sums over the subtree of |g| |P|, plain and times the path's u. Needs c_mass.
template <class T> void plan_gravity_rows(Plan<T>&, const Tree&, const std::vector<double>& weight);
// carried_moment: P, the first moment that a body's own turning moves, body axes. Needs c_mass.
template <class T> void plan_carried_moments(Plan<T>&, const Tree&);
// carried_drag: the same of kappa rho A (air.h), body axes. Needs drag_area.
template <class T> void plan_carried_drag(Plan<T>&, const Tree&);

} // namespace bough
