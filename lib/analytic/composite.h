// composite.h: composite body update, (1)-(4), one backward sweep.
//
// The composite of body p is p with all that is outboard, taken as rigid. Everything is kept about p's own joint in world axes, by first moments,
// instead of (2)'s form about centres of mass. With h = m_hat p_hat the first moment and J the inertia about the joint, a child at offset r adds
//   h_p += h_c + m_c r          J_p += J_c + 2 (r.q) 1 - r q^T - q r^T,  q = h_c + m_c r / 2
//   f_p += f_c                  tau_p += tau_c + r x f_c                                           (3), (4)
// This is (1)-(2) with Steiner's theorem applied once, J = I_hat - m_hat p_hat* p_hat*. It subtracts no nearly equal terms. (4)'s vector p_hat^a
// points from the child's joint to the parent's, r the other way. The mass (1) is constant (plan.h). Gravity's torque is h x g, so it has no force
// array.
// Reads   R_wb; f_w, tau_w; drag_f_w, drag_tau_w, the bounds (each where the plan has it).
// Writes  c_h_w, c_J_w, c_f_w, c_tau_w, c_drag_f_w, c_drag_tau_w, c_drag, c_wind, c_turn and their rows.
// After   external_forces. Needs parent[i] < i. O(n). A parent adds its children in falling index order, so the thread
//         count cannot change a result. Errors none.
#pragma once
#include "analytic_state.h"

namespace bough {

template <class T> void composite_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&);

} // namespace bough
