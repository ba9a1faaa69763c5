#include "step.h"
#include "composite.h"
#include "drag.h"
#include "external_forces.h"
#include "root_term.h"
#include "spring.h"
#include "state_update.h"
#include "wind.h"
#include <chrono>

namespace bough {
namespace {

template <class T, class Body> void run(Stage stage, State<T>& state, StageClock* clock, Body&& body) {
    using Time = std::chrono::steady_clock;
    const Time::time_point start = clock ? Time::now() : Time::time_point{};
    body();
    ++state.calls[std::size_t(stage)];
    if (clock) clock->seconds[std::size_t(stage)] += std::chrono::duration<double>(Time::now() - start).count();
}

} // namespace

template <class T> void step(const Plan<T>& plan, State<T>& state, StageClock* clock) {
    // Loads that depend on time are taken in the middle of the step, where their error is of second order.
    const double middle = (double(state.step) + 0.5) * plan.dt;
    if (plan.wind) run(Stage::wind_field, state, clock, [&] { evaluate_wind(*plan.scene.wind, middle, state.wind); });
    if (plan.forces) run(Stage::external_forces, state, clock, [&] { external_forces(plan, state, middle); });
    run(Stage::composite, state, clock, [&] { composite_update(plan, state); });
    if (plan.wind) run(Stage::drag, state, clock, [&] { joint_drag(plan, state); });
    if (plan.root_motion) run(Stage::root_motion, state, clock, [&] { root_loads(plan, state, middle); });
    run(Stage::spring, state, clock, [&] { spring_update(plan, state); });
    run(Stage::state_update, state, clock, [&] {
        move_ground(plan, state, double(state.step + 1) * plan.dt);
        state_update(plan, state);
    });
    if (plan.torque) spring_torque(plan, state);
    ++state.step;
}

template void step(const Plan<float>&, State<float>&, StageClock*);
template void step(const Plan<double>&, State<double>&, StageClock*);

} // namespace bough
