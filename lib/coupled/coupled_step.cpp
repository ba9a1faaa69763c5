#include "coupled_step.h"
#include "../plan/ground.h"
#include "../plan/spring_torque.h"
#include "../plan/state_update.h"
#include "attachment.h"
#include "body_load.h"
#include "energy_guard.h"
#include "half_turn.h"
#include "limits.h"
#include "midpoint.h"
#include "pulled_points.h"
#include "resolvent.h"

namespace bough {
namespace {

template <class T> void solve(const Plan<T>& plan, const CoupledPlan<T>& own, State<T>& state, CoupledWork<T>& work) {
    const RationalScheme& scheme = scheme_of(own.scheme);
    for (Vector3<T>& change : work.theta_change) change.setZero();
    for (Vector3<T>& change : work.theta_dot_change) change.setZero();
    for (int k = 0; k < scheme.poles; ++k) resolvent(plan, own, state, work, scheme.pole[std::size_t(k)]);
}

template <class T> void take(const Plan<T>& plan, State<T>& state, CoupledWork<T>& work) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        Vector3<T>&theta = state.theta[i], &eta = state.theta_dot[i];
        theta += work.theta_change[i];
        eta += work.theta_dot_change[i];
        if (const GroundStep<T>* ground = ground_step_of(plan, work, i); ground && ground->jumps) {
            work.theta_change[i] = T(plan.dt) * eta;
            work.theta_dot_change[i].setZero();
        }
        if (take_shorter_way(theta, eta, work.theta_change[i], work.theta_dot_change[i], T(plan.dt)))
            ++state.flags.half_turns;
    }
}

} // namespace

template <class T>
void coupled_step(const Plan<T>& plan, const CoupledPlan<T>& own, State<T>& state, CoupledWork<T>& work,
                  StageClock* clock) {
    const double time = time_of(plan, state), end = time_of(plan, state, 1);
    if (plan.wind) run_stage(Stage::wind_field, state, clock, [&] { wind_over_step(plan, state, work, time); });
    run_stage(Stage::midpoint, state, clock, [&] {
        ground_over_step(plan, own, work, time);
        midpoint(plan, state, work, scheme_of(own.scheme).extrapolates);
    });
    run_stage(Stage::body_loads, state, clock, [&] { body_loads(plan, own, state, work, time); });
    take_loads(plan, state, work.attachments);
    const bool holds = work.attachments.any();
    if (holds)
        run_stage(Stage::attachments, state, clock, [&] {
            read_attached(state, work);
            place_attachments(plan, own, work, time);
        });
    run_stage(Stage::resolvent, state, clock, [&] { solve(plan, own, state, work); });
    run_stage(Stage::state_update, state, clock, [&] {
        if (holds) {
            read_attached(state, work);
            settle_attachments(work.attachments);
        }
        const bool watched = weigh_start(plan, state, work, time);
        take(plan, state, work);
        move_ground(plan, state, end);
        state_update(plan, state);
        if (watched) guard_energy(plan, state, work, time);
        if (plan.joint_limit && keep_limits(plan, state, work)) state_update(plan, state);
    });
    if (plan.torque) spring_torque(plan, state);
    ++state.step;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void coupled_step(const Plan<T>&, const CoupledPlan<T>&, State<T>&, CoupledWork<T>&, StageClock*);
#include "../base/instantiate.inc"

} // namespace bough
