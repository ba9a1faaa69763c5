// tip_position.h: where a body's far end is, for estimates and comparisons of motions.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// [m] Returns a body's far end in the world. Needs a state that is presented. O(1).
template <class T> Vec3 end_position(const State<T>& state, const Tree& tree, std::size_t body) {
    return state.x_w[body].template cast<double>() +
           state.R_wb[body].template cast<double>().col(2) * tree.size[body][0];
}

// [m] Returns it as seen from its tree's ground: being carried is no deflection. Needs a state that is presented. O(log moved trees).
template <class T> Vec3 tip_position(const Plan<T>&, const State<T>&, const Tree&, std::size_t body);

} // namespace bough
