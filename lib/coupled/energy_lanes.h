// energy_lanes.h: the energy guard (coupled/energy_guard.h) on rows of lanes. It is written a second time because it weighs rows and not arrays of
// bodies. tests/lib/coupled/energy_guard.cpp holds the two together.
#pragma once
#include "coupled_lanes_state.h"
#include "coupled_rows.h"

namespace bough::fast {

// Called when the table (coupled_places.h) holds a step's motion and its start. Weighs the trees that lanes.watched marks, and scales the rates at
// the end of those that gained energy. O(n), blocks in parallel. Allocates its working memory when it is first needed, and a bit a block.
template <class T>
void guard_lanes(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&, const CoupledRows<T>&);

} // namespace bough::fast
