#include "ground.h"

namespace bough {

template <class T> void move_ground(const Plan<T>& plan, State<T>& state, double time) {
    for (std::size_t k = 0; k < plan.splines.size(); ++k) state.ground[k] = ground_at(plan.splines[k], time);
}

template void move_ground(const Plan<float>&, State<float>&, double);
template void move_ground(const Plan<double>&, State<double>&, double);

} // namespace bough
