// analytic_lanes_step.h: the analytic step (analytic/analytic_step.h) by sweeps over lanes, and what moves between its rows and the
// state's arrays in document order.
//
// Order. First the top goes outward. Each block then goes outward and inward; threads share the blocks out. The blocks' roots go into the top, in a
// fixed order, and the top goes inward. Sums stand in the layout's order: the result is the same for any number of threads. Only theta, theta_dot and
// scaled_rate are carried, in place: the next step needs nothing else of this one.
#pragma once
#include "../lanes/lane_memory.h"
#include "analytic_lanes_state.h"

namespace bough::fast {

// Puts the bodies' constants into rows (analytic_rows.h), once the layout stands.
template <class T> void fill_analytic(const Plan<T>&, AnalyticLanesPlan<T>&);

// Puts the constants of a lane without a body (clear_lanes.h): an inertia whose eigenvalues can be found, and a spring neither soft nor stiff over
// any step. So no kernel takes a case for it that the bodies beside it do not need. All its other values are zero.
template <class T> void put_analytic_pad(const Slot<T>&);

// pack() fills the state's rows from theta [rad] and from its arrays in document order, zero where one is left out; unpack() goes back. O(n).
template <class T>
void pack_analytic(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&,
                   const std::vector<Vector3<T>>& theta);
template <class T> void unpack_analytic(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&);

// Advances the rows by plan.dt. The arrays in document order are left behind.
template <class T>
void analytic_lanes_step(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&,
                         StageClock* clock);

} // namespace bough::fast
