// external_forces.h: forces on each body from outside but gravity (§4, §7): pulls and the wind.
//
// Gravity has no array here: its torque about a joint is h x g with the composite's first moment h (composite.h).
// The wind's force on a body is air.h's (21)-(23) times kappa rho A, kappa = C_d / 2, C_d = 1.2 (branch, leaf), 0.47 (fruit).
// It is written in two parts: what it would be on a body that stands still, which goes to the springs, and the rest,
// which is the drag on the body's own motion and goes to drag.h; their sum is the force. The rest is at most
// drag_bound |v| with drag_bound = kappa rho A (|u| + |u at rest|) (|u_n| for branches), since || u|u - w|w| || <= (|u| + |w|) |u - w|.
// A body "stands still" when it does on its tree's ground: where the root is moved, u at rest is the wind's velocity less that
// of the ground carried to the body, so that a tree driven through still air is a tree that stands in the wind.
// What the implicit step needs to know of the part at rest (drag.h): wind_bound = kappa rho A |u at rest| is what it falls by,
// over the speed, from rest to going with the wind; that with the body's direction (force and arm both turn with it) at most turn_bound =
// 3, 2, 1 (branch, leaf, fruit) times kappa rho A |u at rest|^2 a radian.
// With /leaves a leaf's resistance and torque (leaf_air.h) are parted likewise and come to the same bounds: nu m and 2 k |u| over the arm to drag_bound (and
// nu I, as what it is at that arm), nu m to wind_bound, twice their moments over the arm to turn_bound; the arm, AnalyticPlan::com_distance, is then such that
// its square holds the centre of mass's and the radius of gyration's.
// Reads   R_wb, x_w, v_w (with wind; omega_w with /leaves), time. Writes f_w, tau_w, drag_f_w, drag_tau_w and the bounds.
// After   state_update of the step before, wind_field. O(n + pulls), bodies in parallel. Errors none.
#pragma once
#include "analytic_state.h"

namespace bough {

template <class T>
void external_forces(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, double time);

} // namespace bough
