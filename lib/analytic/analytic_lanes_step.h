// analytic_lanes_step.h: the analytic step (analytic/analytic_step.h) by sweeps over lanes, and what moves between its rows and the
// state's arrays in document order.
//
// Order. The top outward; each block outward and inward, blocks shared out among threads; the blocks' roots, in a fixed order, into
// the top; the top inward. Sums stand in the layout's order: one result for any number of threads. All that is carried is
// theta, theta_dot and scaled_rate, in place: nothing that a step worked out is needed by the next.
#pragma once
#include "../lanes/lane_memory.h"
#include "analytic_lanes_state.h"

namespace bough::fast {

// The bodies' constants in rows (analytic_rows.h), once the layout stands.
template <class T> void fill_analytic(const Plan<T>&, AnalyticLanesPlan<T>&);

// Constants of a lane without a body (clear_lanes.h): an inertia whose eigenvalues can be found, and a spring neither soft nor stiff over any
// step, so that no kernel takes a case for it that the bodies beside it do not need. All others of it are zero.
template <class T> void put_analytic_pad(const Slot<T>&);

// The state's rows from theta [rad] and from its arrays in document order, zero where one is left out; and back. O(n).
template <class T>
void pack_analytic(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&,
                   const std::vector<Vector3<T>>& theta);
template <class T> void unpack_analytic(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&);

// theta_dot of the body in a slot: where coefficients are kept, from the rates of its modes.
template <class T> Vector3<T> analytic_theta_dot(const Lanes<T>&, std::size_t slot);

// Advances the rows by plan.dt; the arrays in document order are left behind.
template <class T>
void analytic_lanes_step(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&,
                         StageClock* clock);

} // namespace bough::fast
