#include "step.h"
#include "composite.h"
#include "drag.h"
#include "external_forces.h"
#include "fictitious.h"
#include "root_term.h"
#include "spring.h"
#include "state_update.h"
#include "wind.h"
#include <stdexcept>

namespace bough {
namespace {

template <class T> void require_plain_analytic(const Plan<T>& plan) {
    if (plan.solver == Solver::analytic && !plan.lanes.on) return;
    throw std::logic_error(std::string("step: is the analytic solver's without SIMD lanes, the plan is of ") +
                           solver_name(plan.solver) + (plan.lanes.on ? " with lanes" : "") +
                           ": call advance (reference/advance.h)");
}

} // namespace

template <class T> void step(const Plan<T>& plan, State<T>& state, StageClock* clock) {
    require_plain_analytic(plan);
    // Loads that depend on time are taken in the middle of the step, where their error is of second order.
    const double time = double(state.step) * plan.dt, middle = (double(state.step) + 0.5) * plan.dt;
    if (plan.wind)
        run_stage(Stage::wind_field, state, clock, [&] { evaluate_wind(*plan.scene.wind, middle, state.wind); });
    if (plan.forces) run_stage(Stage::external_forces, state, clock, [&] { external_forces(plan, state, middle); });
    run_stage(Stage::composite, state, clock, [&] { composite_update(plan, state); });
    if (plan.wind) run_stage(Stage::drag, state, clock, [&] { joint_drag(plan, state); });
    if (plan.root_motion) run_stage(Stage::root_motion, state, clock, [&] { root_loads(plan, state, time); });
    if (plan.fictitious) run_stage(Stage::fictitious, state, clock, [&] { fictitious_torques(plan, state); });
    run_stage(Stage::spring, state, clock, [&] { spring_update(plan, state); });
    run_stage(Stage::state_update, state, clock, [&] {
        move_ground(plan, state, double(state.step + 1) * plan.dt);
        state_update(plan, state);
    });
    if (plan.torque) spring_torque(plan, state);
    ++state.step;
}

template void step(const Plan<float>&, State<float>&, StageClock*);
template void step(const Plan<double>&, State<double>&, StageClock*);

} // namespace bough
