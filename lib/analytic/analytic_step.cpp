#include "analytic_step.h"
#include "../laws/wind.h"
#include "../plan/ground.h"
#include "../plan/spring_torque.h"
#include "../plan/state_update.h"
#include "composite.h"
#include "drag.h"
#include "external_forces.h"
#include "fictitious.h"
#include "held_points.h"
#include "root_term.h"
#include "spring.h"

namespace bough {
template <class T>
void analytic_step(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work,
                   StageClock* clock) {
    // Loads that depend on time are taken in the middle of the step, where their error is of second order.
    const double time = time_of(plan, state), middle = time_of(plan, state, 0.5);
    if (plan.wind)
        run_stage(Stage::wind_field, state, clock, [&] { evaluate_wind(*plan.scene.wind, middle, state.wind); });
    if (plan.forces)
        run_stage(Stage::external_forces, state, clock, [&] { external_forces(plan, own, state, work, middle); });
    run_stage(Stage::composite, state, clock, [&] { composite_update(plan, own, state, work); });
    if (plan.wind) run_stage(Stage::drag, state, clock, [&] { joint_drag(plan, own, state, work); });
    if (plan.root_motion) run_stage(Stage::root_motion, state, clock, [&] { root_loads(plan, work, time); });
    if (own.fictitious) run_stage(Stage::fictitious, state, clock, [&] { fictitious_torques(plan, state, work); });
    if (work.held.any())
        run_stage(Stage::attachments, state, clock, [&] { hold_points(plan, own, state, work, time); });
    run_stage(Stage::spring, state, clock, [&] {
        spring_update(plan, own, state, work);
        if (work.held.any()) slow_held(plan, state, work);
    });
    run_stage(Stage::state_update, state, clock, [&] {
        move_ground(plan, state, time_of(plan, state, 1));
        state_update(plan, state);
        if (own.fictitious) accelerations(plan, state, work);
    });
    if (plan.torque) spring_torque(plan, state);
    ++state.step;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void analytic_step(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, StageClock*);
#include "../base/instantiate.inc"

} // namespace bough
