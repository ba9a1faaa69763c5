#include "spring.h"
#include "../base/parallel.h"
#include "../laws/joint_limit.h"
#include "spring_joint.h"
#include <atomic>

namespace bough {

template <class T>
StepFlags spring_update(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& s, AnalyticWork<T>& work,
                        std::size_t i) {
    const SpringJoint<T> joint = spring_joint(plan, own, s, work, i);
    const SpringOscillators<T> o = spring_oscillators(plan, own, s, work, joint, i);
    StepFlags flags;
    flags.buckling = o.buckling;
    flags.bounded_lambda = o.bounded;
    const Vector3<T> r = o.U.transpose() * joint.residual_b;
    const Vector3<T> v = o.X.transpose() * work.scaled_rate[i]; // U^-1 theta_dot = X^T L^T theta_dot
    auto [dq, v_new] = turn_of_modes(o, r, v);
    const Vector3<T> phi = o.U * dq, next = s.theta[i] + joint.T_tb * phi;
    v_new *= kept_of_rate(plan, joint, i, s.theta[i], next, phi, v, v_new, flags);
    s.theta[i] = next;
    work.scaled_rate[i] = o.X * v_new;
    Vector3<T> omega_b = o.U * v_new;
    if (plan.joint_limit && stop_at_limit(plan.theta_limit[i], o.L, s.theta[i], work.scaled_rate[i])) {
        ++flags.limited;
        omega_b = work.scaled_rate[i];
        o.L.transpose().template triangularView<Eigen::Upper>().solveInPlace(omega_b);
    }
    if (shorten_rotation(s.theta[i])) ++flags.half_turns;
    s.theta_dot[i] = body_rate_jacobian_inverse(s.theta[i]) * omega_b;
    if (own.fictitious) { // the oscillators' own equation at the step's end
        Vector3<T> change;
        for (int k = 0; k < 3; ++k)
            change[k] = o.ratio[k] * (r[k] + o.d[k] * v[k]) - o.b[k] * v_new[k] - o.lambda[k] * dq[k];
        work.spin_dot[i] = o.U * change;
    }
    return flags;
}

template <class T>
void spring_update(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work) {
    const auto add = [](std::uint64_t& to, std::uint64_t count) { // rare: all threads add to one number
        if (count) std::atomic_ref(to).fetch_add(count, std::memory_order_relaxed);
    };
    parallel_for(plan.bodies, 500, [&](std::size_t i) {
        const StepFlags flags = spring_update(plan, own, state, work, i);
        add(state.flags.buckling, flags.buckling);
        add(state.flags.bounded_lambda, flags.bounded_lambda);
        add(state.flags.half_turns, flags.half_turns);
        add(state.flags.energy_guard, flags.energy_guard);
        add(state.flags.limited, flags.limited);
    });
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template StepFlags spring_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&,              \
                                     std::size_t);                                                                     \
    template void spring_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&);
#include "../base/instantiate.inc"

} // namespace bough
