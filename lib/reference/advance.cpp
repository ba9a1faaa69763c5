#include "advance.h"
#include "../coupled/coupled_step.h"
#include "../fast/analytic_lanes_step.h"
#include "../fast/coupled_lanes_step.h"
#include "../stages/root_term.h"
#include "../stages/spring.h"
#include "../stages/state_update.h"
#include "articulated_step.h"
#include "extrapolation.h"
#include <stdexcept>

namespace bough {
namespace {

// The solvers' own arrays hold a joint's rotation vector and rate while the pass runs.
void articulated_euler(const Plan<double>& plan, State<double>& state, double time) {
    ArticulatedPass& pass = state.articulated[0];
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        pass.body[i].theta = state.theta[i];
        pass.body[i].rate = state.scaled_rate[i];
    }
    if (plan.solver == Solver::articulated_explicit)
        explicit_euler(plan, pass, time, plan.dt);
    else
        implicit_euler(plan, pass, time, plan.dt);
    state.flags.fast_turns += pass.fast;
    pass.fast = 0;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        state.theta[i] = pass.body[i].theta;
        state.scaled_rate[i] = pass.body[i].rate;
    }
}

void articulated(const Plan<double>& plan, State<double>& state) {
    const double time = double(state.step) * plan.dt;
    if (plan.solver == Solver::articulated_reference)
        extrapolated_step(plan, state, time);
    else
        articulated_euler(plan, state, time);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        if (shorten_rotation(state.theta[i])) ++state.flags.half_turns; // as the analytic step does (spring.h)
        state.theta_dot[i] = body_rate_jacobian_inverse(state.theta[i]) * state.scaled_rate[i];
    }
}

} // namespace

template <class T> void advance(const Plan<T>& plan, State<T>& state, StageClock* clock) {
    const bool analytic = plan.solver == Solver::analytic;
    if (plan.lanes.on && analytic) return fast::analytic_lanes_step(plan, state, clock);
    if (plan.lanes.on) return fast::coupled_lanes_step(plan, state, clock);
    if (analytic) return step(plan, state, clock);
    if (plan.solver == Solver::coupled) return coupled_step(plan, state, clock);
    if constexpr (std::is_same_v<T, double>) {
        run_stage(Stage::articulated, state, clock, [&] { articulated(plan, state); });
        run_stage(Stage::state_update, state, clock, [&] {
            move_ground(plan, state, double(state.step + 1) * plan.dt);
            state_update(plan, state);
        });
        if (plan.torque) spring_torque(plan, state);
        ++state.step;
    } else {
        throw std::logic_error(std::string("advance: ") + solver_name(plan.solver) + " exists in double alone");
    }
}

template void advance(const Plan<float>&, State<float>&, StageClock*);
template void advance(const Plan<double>&, State<double>&, StageClock*);

} // namespace bough
