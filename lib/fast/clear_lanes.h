// clear_lanes.h: pads, and bodies that become such because they broke off their tree (free/fracture.h).
//
// A pad, a body that is none, goes with its parent and hands on as good as nothing. In the coupled step: no mass, no inertia, a spring never bent.
// In the analytic step an inertia [kg m^2] whose eigenvalues can be found; its spring is neither soft nor stiff over any step, so that no
// kernel takes a case for it that the bodies beside it do not need. Nothing bends it, and its motion, which no saved state holds, stays 0.
#pragma once
#include "../stages/plan.h"
#include "../stages/state.h"
#include "lane_memory.h"

namespace bough::fast {

template <class T> constexpr T pad_inertia = sizeof(T) == 4 ? T(1e-20) : T(1e-40);
template <class T> constexpr T pad_rate2 = T(1e4); // [1/s^2] K over inertia

// Constants of a lane without a body; all others of it are zero.
template <class T> void put_pad(const Slot<T>&);
template <class T> void put_analytic_pad(const Slot<T>&);

// Makes the bodies' lanes pads at rest. The plan's rows share no constants, here as below (shared_constants.h). O(bodies + rows).
template <class T> void clear_lanes(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies);

// Plan::carried_moment of a body, where its lane has it.
template <class T> void put_carried_moment(Plan<T>&, std::size_t body);

} // namespace bough::fast
