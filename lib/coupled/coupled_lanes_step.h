// coupled_lanes_step.h: the coupled step (coupled_step.h) by sweeps over lanes, and what moves between its rows and the
// state's arrays in document order.
//
// Order. First the top goes outward. Each block then goes outward and inward; threads share the blocks out. The blocks' roots go into the top, in a
// fixed order. The top goes inward and outward again, then the blocks outward again, last one first. Sums stand in the layout's order: the result is
// the same for any number of threads. Where a body turns by more than 0.3 rad in the step, the energy guard looks at its tree (energy_lanes.h).
#pragma once
#include "coupled_lanes_state.h"

namespace bough::fast {

// Puts the bodies' constants into rows (coupled_rows.h), once the layout stands. Reads those of CoupledPlan.
template <class T> void fill_coupled(const Plan<T>&, CoupledLanesPlan<T>&);

// pack() fills the state's rows from theta [rad] and from its arrays in document order, zero where one is left out; unpack() goes back. O(n).
template <class T>
void pack(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&,
          const std::vector<Vector3<T>>& theta);
template <class T> void unpack(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&);

// Advances the rows by plan.dt. The arrays in document order are left behind.
template <class T>
void coupled_lanes_step(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&,
                        StageClock* clock);

} // namespace bough::fast
