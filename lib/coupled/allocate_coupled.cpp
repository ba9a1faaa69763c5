#include "allocate_coupled.h"
#include "attachment.h"

namespace bough {

template <class T>
void allocate_coupled(const Plan<T>& plan, State<T>& state, CoupledState<T>& own, std::size_t roots) {
    if (plan.pose) {
        own.theta_change.assign(plan.bodies, Vector3<T>::Zero());
        own.theta_dot_change.assign(plan.bodies, Vector3<T>::Zero());
    }
    if (plan.wind) state.wind = make_wind_table<T>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    if (plan.field)
        own.wind_start = own.wind_end = state.wind.field;
    else
        own.wind_change = state.wind;
    own.ground.resize(plan.splines.size());
    own.account.resize(roots);
    if (!plan.attachments.empty() || !plan.followers.empty() || !plan.pulls.empty()) begin_attachments(plan, own);
}

template void allocate_coupled(const Plan<float>&, State<float>&, CoupledState<float>&, std::size_t);
template void allocate_coupled(const Plan<double>&, State<double>&, CoupledState<double>&, std::size_t);

} // namespace bough
