// ground.h: the present grounds of trees whose roots are moved.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// Writes each spline's Ground at `time` [s] into state.ground.
template <class T> void move_ground(const Plan<T>&, State<T>&, double time);

// Returns the ground under body i, or null where it rests.
template <class T> const Ground* ground_of(const Plan<T>& plan, const State<T>& state, std::size_t i) {
    const std::int64_t spline = spline_under(plan.moved, i);
    return spline < 0 ? nullptr : &state.ground[std::size_t(spline)];
}

} // namespace bough
