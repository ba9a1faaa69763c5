#include "body_load.h"
#include "../base/parallel.h"
#include "../base/resolved_turn.h"
#include "../laws/air_load.h"
#include "../model/own_inertia.h"
#include "../plan/body_air.h"
#include "../plan/pushes.h"

namespace bough {

template <class T> void wind_over_step(const Plan<T>& plan, State<T>& state, CoupledState<T>& work, double time) {
    const Wind& wind = *plan.scene.wind;
    if (plan.field) {
        evaluate_field(wind, time, work.wind_start);
        evaluate_field(wind, time + plan.dt, work.wind_end);
        return evaluate_wind(wind, time + plan.dt / 2, state.wind);
    }
    evaluate_wind(wind, time, state.wind);
    evaluate_wind(wind, time + plan.dt, work.wind_change);
    for (std::size_t k = 0; k < state.wind.velocity.size(); ++k) work.wind_change.velocity[k] -= state.wind.velocity[k];
    evaluate_wind(wind, time + plan.dt / 2, state.wind);
}

namespace {

// What the wind on a body changes by over the step.
template <class T>
Vector3<T> wind_change(const Plan<T>& plan, const State<T>& state, const CoupledState<T>& work, std::size_t i,
                       const Vector3<T>& place) {
    if (!work.wind_end.on()) return work.wind_change.at(place.y());
    return wind_change_on_body_at(plan, i, state.wind, work.wind_start, work.wind_end, place);
}

template <class T>
void add_air(const Plan<T>& plan, const CoupledPlan<T>& own, const State<T>& state, const CoupledWork<T>& work,
             CoupledBody<T>& b, std::size_t i) {
    const AirBody<T> body = air_body<T>(plan, i);
    const Vector3<T> place = b.x + b.c;
    const Vector3<T> u = wind_on_body_at(plan, i, state.wind, place) - b.v - b.omega.cross(b.c);
    const Vector3<T> ahead = b.v - b.v_0 + (b.omega - b.omega_0).cross(b.c);
    const AirLoad<T> air = air_load(body, plan.leaf, b.R, u);
    b.air = air.force;
    b.spin = air.spin;
    b.D = air_load_damping(body, plan.leaf, b.R, u);
    b.N -= air.torque;
    if (b.spin > 0) b.N += b.spin * (central_inertia(body.mass, b.J, b.c) * b.omega_0);
    const Vector3<T> f = b.air + b.D * ahead;
    b.F -= f;
    b.N -= b.c.cross(f);
    b.slope_F = -b.D * wind_change(plan, state, work, i, place);
    b.slope_N = b.c.cross(b.slope_F);
    add_air_turning(body, plan.leaf, b.R, u, {plan.foliage, b.R * own.carried_drag[i]}, T(1), b.H);
}

template <class T>
void load(const Plan<T>& plan, const CoupledPlan<T>& own, State<T>& state, CoupledWork<T>& work, std::size_t i) {
    CoupledBody<T>& b = work.coupled[i];
    const T m = plan.mass[i];
    const Vector3<T> g = plan.scene.gravity.template cast<T>();
    std::uint64_t seen = 0; // counted by midpoint()
    const Vector3<T> spin = resolved_turn(b.omega, T(plan.dt), seen);
    b.J = b.R * own_inertia(plan.inertia_joint[i]) * b.R.transpose();
    b.H.setZero();
    if (plan.gravity) {
        const Vector3<T> P = b.R * own.carried_moment[i];
        const Matrix3<T> Pg = P * g.transpose();
        b.H = P.dot(g) * Matrix3<T>::Identity() - T(0.5) * (Pg + Pg.transpose());
    }
    b.F = m * (b.a_0 - g + b.alpha_0.cross(b.c) + spin.cross(spin.cross(b.c)));
    b.N = b.J * b.alpha_0 + spin.cross(b.J * spin) + m * b.c.cross(b.a_0 - g);
    if (plan.forces) {
        b.slope_F.setZero();
        b.slope_N.setZero();
    }
    if (plan.wind) add_air(plan, own, state, work, b, i);
    b.N -= b.H * b.turn;
    const Vector3<T>& K = plan.K[i];
    b.torque = -b.rates.transpose() * K.cwiseProduct(Vector3<T>(state.theta[i] + plan.beta[i] * state.theta_dot[i]));
    b.torque_rate = b.rates.transpose() * K.cwiseProduct(state.theta_dot[i]);
}

template <class T> void add_pulls(const Plan<T>& plan, State<T>& state, CoupledWork<T>& work, double time) {
    const double at = time + plan.dt / 2;
    for (const PlannedPull<T>& pull : plan.pulls) {
        CoupledBody<T>& b = work.coupled[pull.body];
        const Pull& source = plan.scene.pulls[pull.source];
        const Vector3<T> arm = b.R * pull.point_b, f = pull_force(source, at).template cast<T>();
        const Vector3<T> change = (pull_force(source, time + plan.dt) - pull_force(source, time)).template cast<T>();
        b.F -= f;
        b.N -= arm.cross(f);
        b.slope_F -= change;
        b.slope_N -= arm.cross(change);
    }
    for (const Load<T>& load : state.loads) {
        CoupledBody<T>& b = work.coupled[load.body];
        b.F -= load.force;
        b.N -= Vector3<T>(b.R * load.point_b).cross(load.force);
    }
}

} // namespace

template <class T>
void body_loads(const Plan<T>& plan, const CoupledPlan<T>& own, State<T>& state, CoupledWork<T>& work, double time) {
    parallel_for(plan.bodies, 100, [&](std::size_t i) { load(plan, own, state, work, i); });
    add_pulls(plan, state, work, time);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void wind_over_step(const Plan<T>&, State<T>&, CoupledState<T>&, double);                                 \
    template void body_loads(const Plan<T>&, const CoupledPlan<T>&, State<T>&, CoupledWork<T>&, double);
#include "../base/instantiate.inc"

} // namespace bough
