// frozen_lanes.h: frozen coefficients (stages/frozen.h) in the fast path's rows.
#pragma once
#include "../stages/state.h"

namespace bough::fast {

// Makes the rows where there are none. Of joints that have no coefficients yet, so that the next step makes them, from rates that are scaled_rate as
// spring.h has it: modes that leave them what they are, and turn them into what the joint's rate is. (Without Plan::pose the constants for the
// latter are gone: a state that moves then needs coefficients.) O(n).
template <class T> void start_frozen(const Plan<T>&, State<T>&);

// A body's FrozenJoint as its numbers in order.
template <class T> void read_frozen(const Plan<T>&, const State<T>&, std::size_t body, T* numbers);
template <class T> void write_frozen(const Plan<T>&, State<T>&, std::size_t body, const T* numbers);

} // namespace bough::fast
