#include "ground.h"

namespace bough {

template <class T> void move_ground(const Plan<T>& plan, State<T>& state, double time) {
    for (std::size_t k = 0; k < plan.splines.size(); ++k) state.ground[k] = ground_at(plan.splines[k], time);
}

#define BOUGH_INSTANTIATE(T) template void move_ground(const Plan<T>&, State<T>&, double);
#include "../base/instantiate.inc"

} // namespace bough
