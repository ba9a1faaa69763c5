#include "coupled_step.h"
#include "../stages/root_term.h"
#include "../stages/spring.h"
#include "../stages/state_update.h"
#include "body_load.h"
#include "energy_guard.h"
#include "half_turn.h"
#include "limits.h"
#include "midpoint.h"
#include "resolvent.h"

namespace bough {
namespace {

template <class T> void solve(const Plan<T>& plan, State<T>& state) {
    const RationalScheme& scheme = scheme_of(plan.scheme);
    for (Vector3<T>& change : state.theta_change) change.setZero();
    for (Vector3<T>& change : state.theta_dot_change) change.setZero();
    for (int k = 0; k < scheme.poles; ++k) resolvent(plan, state, scheme.pole[std::size_t(k)]);
}

template <class T> void take(const Plan<T>& plan, State<T>& state) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        Vector3<T>&theta = state.theta[i], &eta = state.theta_dot[i];
        theta += state.theta_change[i];
        eta += state.theta_dot_change[i];
        if (const GroundStep<T>* ground = ground_step_of(plan, state, i); ground && ground->jumps) {
            state.theta_change[i] = T(plan.dt) * eta;
            state.theta_dot_change[i].setZero();
        }
        if (take_shorter_way(theta, eta, state.theta_change[i], state.theta_dot_change[i], T(plan.dt)))
            ++state.flags.half_turns;
    }
}

} // namespace

template <class T> void coupled_step(const Plan<T>& plan, State<T>& state, StageClock* clock) {
    const double time = double(state.step) * plan.dt, end = double(state.step + 1) * plan.dt;
    if (plan.wind) run_stage(Stage::wind_field, state, clock, [&] { wind_over_step(plan, state, time); });
    run_stage(Stage::midpoint, state, clock, [&] {
        ground_over_step(plan, state, time);
        midpoint(plan, state, scheme_of(plan.scheme).extrapolates);
    });
    run_stage(Stage::body_loads, state, clock, [&] { body_loads(plan, state, time); });
    run_stage(Stage::resolvent, state, clock, [&] { solve(plan, state); });
    run_stage(Stage::state_update, state, clock, [&] {
        const bool watched = weigh_start(plan, state, time);
        take(plan, state);
        move_ground(plan, state, end);
        state_update(plan, state);
        if (watched) guard_energy(plan, state, time);
        if (plan.joint_limit && keep_limits(plan, state)) state_update(plan, state);
    });
    if (plan.torque) spring_torque(plan, state);
    ++state.step;
}

template void coupled_step(const Plan<float>&, State<float>&, StageClock*);
template void coupled_step(const Plan<double>&, State<double>&, StageClock*);

} // namespace bough
