#include "external_forces.h"
#include "../base/parallel.h"
#include "../laws/parted_air.h"
#include "../plan/body_air.h"
#include "../plan/ground.h"
#include "../plan/pushes.h"
#include <algorithm>

namespace bough {

namespace {

template <class T>
void wind_on_body(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work,
                  std::size_t i) {
    const Matrix3<T>& R = state.R_wb[i];
    const Vector3<T> place = state.x_w[i] + R * plan.com[i];
    Vector3<T> wind = wind_on_body_at(plan, i, state.wind, place), v = state.v_w[i], turning = Vector3<T>::Zero();
    if (const Ground* ground = plan.root_motion ? ground_of(plan, state, i) : nullptr) {
        const Vec3 carried = ground->v + ground->omega.cross(place.template cast<double>() - ground->x);
        wind -= carried.template cast<T>();
        v -= carried.template cast<T>();
        turning = ground->omega.template cast<T>();
    }
    const Vector3<T> omega = is_foliage(plan.kind[i]) ? state.omega_w[i] : Vector3<T>(Vector3<T>::Zero());
    const PartedAir<T> air = parted_air(air_body<T>(plan, i), plan.leaf, R, plan.inertia_joint[i], own.com_distance[i],
                                        {wind, wind - v, turning, omega});
    work.f_w[i] = air.force;
    work.tau_w[i] = air.torque;
    work.drag_f_w[i] = air.drag_force;
    work.drag_tau_w[i] = air.drag_torque;
    work.drag_bound[i] = air.drag;
    work.wind_bound[i] = air.wind;
    work.turn_bound[i] = air.turn;
}

} // namespace

template <class T>
void external_forces(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work,
                     double time) {
    if (plan.wind) {
        parallel_for(plan.bodies, 50, [&](std::size_t i) { wind_on_body(plan, own, state, work, i); });
    } else {
        std::fill(work.f_w.begin(), work.f_w.end(), Vector3<T>::Zero());
        std::fill(work.tau_w.begin(), work.tau_w.end(), Vector3<T>::Zero());
    }
    visit_pushes(plan, state, time, [&](std::size_t body, const Vector3<T>& point_b, const Vector3<T>& f) {
        const Vector3<T> arm = state.R_wb[body] * point_b;
        work.f_w[body] += f;
        work.tau_w[body] += arm.cross(f);
    });
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void external_forces(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&, double);
#include "../base/instantiate.inc"

} // namespace bough
