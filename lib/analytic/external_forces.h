// external_forces.h: forces on each body from outside except gravity (§4, §7): pulls and the wind.
//
// Gravity has no array here: its torque about a joint is h x g with the composite's first moment h (composite.h).
// parted_air.h gives the wind's force in two parts. The force on a body that stands still goes to the springs. The rest is the drag on the body's own
// motion and goes to drag.h, with the three bounds that the implicit step needs to know of both. Their sum is the force. A body stands still when it
// is at rest on its tree's ground. Where the root is moved, u at rest is the wind's velocity less that of the ground carried to the body. So a tree
// driven through still air is a tree that stands in the wind.
// Reads   R_wb, x_w, v_w (with wind; omega_w with /leaves), time. Writes f_w, tau_w, drag_f_w, drag_tau_w and the bounds.
// After   state_update of the step before, wind_field. O(n + pulls), bodies in parallel. Errors none.
#pragma once
#include "analytic_state.h"

namespace bough {

template <class T>
void external_forces(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, double time);

} // namespace bough
