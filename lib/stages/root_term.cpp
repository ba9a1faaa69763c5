#include "root_term.h"

namespace bough {

template <class T> void root_loads(const Plan<T>& plan, State<T>& state, double time) {
    for (std::size_t k = 0; k < plan.splines.size(); ++k) {
        const Ground& now = state.ground[k];
        const Ground middle = ground_at(plan.splines[k], time);
        // A ground that does not turn has the same R bit by bit, and its load no rounding error from R R^T.
        const bool turns = !(now.R.array() == middle.R.array()).all();
        const Mat3 back = turns ? Mat3(now.R * middle.R.transpose()) : Mat3(Mat3::Identity());
        RootLoad<T>& load = state.root_load[k];
        load.x = now.x.template cast<T>();
        load.g = (back * (plan.scene.gravity - middle.a)).template cast<T>();
        load.omega = (back * middle.omega).template cast<T>();
        load.alpha = (back * middle.alpha).template cast<T>();
    }
}

template <class T> void move_ground(const Plan<T>& plan, State<T>& state, double time) {
    for (std::size_t k = 0; k < plan.splines.size(); ++k) state.ground[k] = ground_at(plan.splines[k], time);
}

template void root_loads(const Plan<float>&, State<float>&, double);
template void root_loads(const Plan<double>&, State<double>&, double);
template void move_ground(const Plan<float>&, State<float>&, double);
template void move_ground(const Plan<double>&, State<double>&, double);

} // namespace bough
