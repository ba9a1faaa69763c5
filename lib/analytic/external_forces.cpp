#include "external_forces.h"
#include "../base/parallel.h"
#include "../laws/air.h"
#include "../laws/leaf_air.h"
#include "../plan/ground.h"
#include "../plan/pushes.h"
#include "../plan/shelter.h"
#include <algorithm>

namespace bough {

namespace {

// What the air takes of a body's own turning, at `rate` (air.h, leaf_air.h). turning: its ground's.
template <class T>
void damp_spin(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work, std::size_t i,
               T rate, const Vector3<T>& turning) {
    const Matrix3<T>& R = state.R_wb[i];
    const T m = plan.mass[i];
    const Vector3<T>& c = plan.com[i];
    const Matrix3<T> I = rate * central_inertia(m, plan.inertia_joint[i], c);
    const Vector3<T> omega = state.omega_w[i] - turning;
    work.tau_w[i] -= R * (I * (R.transpose() * turning));
    work.drag_tau_w[i] -= R * (I * (R.transpose() * omega));
    const T arm = std::max(own.com_distance[i], T(1e-9));
    work.drag_bound[i] +=
        m * rate * (1 - c.squaredNorm() / (arm * arm)); // the rate times I is at most this times the arm's square
}

// still, moving: the air's velocity past the body at rest on its ground, and as it goes.
template <class T>
void leaf_in_wind(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work,
                  std::size_t i, const Vector3<T>& still, const Vector3<T>& moving) {
    const Matrix3<T>& R = state.R_wb[i];
    const T m = plan.mass[i], scale = plan.drag_area[i], k = leaf_lever(plan.leaf, scale);
    const Vector3<T> c = R * plan.com[i];
    const Vector3<T> f = leaf_resistance(plan.leaf, m, R, still),
                     drag_f = leaf_resistance(plan.leaf, m, R, Vector3<T>(moving - still));
    const Vector3<T> at_rest = leaf_torque(plan.leaf, scale, R, still);
    work.f_w[i] += f;
    work.tau_w[i] += c.cross(f) + at_rest;
    work.drag_f_w[i] += drag_f;
    work.drag_tau_w[i] += c.cross(drag_f) + leaf_torque(plan.leaf, scale, R, moving) - at_rest;
    const T arm = std::max(own.com_distance[i], T(1e-9)), speed = still.norm();
    work.drag_bound[i] += m * plan.leaf.most + k / arm * (moving.norm() + speed);
    work.wind_bound[i] += m * plan.leaf.most;
    work.turn_bound[i] += 2 * speed * (m * plan.leaf.most + k / arm * speed);
}

template <class T>
void wind_on_body(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work,
                  std::size_t i) {
    const Matrix3<T>& R = state.R_wb[i];
    const Vector3<T> arm = R * plan.com[i];
    const Vector3<T> place = state.x_w[i] + arm;
    Vector3<T> wind = wind_on_body_at(plan, i, state.wind, place), v = state.v_w[i], turning = Vector3<T>::Zero();
    if (const Ground* ground = plan.root_motion ? ground_of(plan, state, i) : nullptr) {
        const Vec3 carried = ground->v + ground->omega.cross(place.template cast<double>() - ground->x);
        wind -= carried.template cast<T>();
        v -= carried.template cast<T>();
        turning = ground->omega.template cast<T>();
    }
    const AirForce<T> still = air_force(plan.kind[i], R, wind);
    const AirForce<T> moving = air_force(plan.kind[i], R, Vector3<T>(wind - v));
    const T scale = plan.drag_area[i];
    work.f_w[i] = scale * still.force;
    work.tau_w[i] = arm.cross(work.f_w[i]);
    work.drag_f_w[i] = scale * (moving.force - still.force);
    work.drag_tau_w[i] = arm.cross(work.drag_f_w[i]);
    work.drag_bound[i] = scale * (moving.speed + still.speed);
    const T pressing = is_foliage(plan.kind[i]) ? still.speed : wind.norm();
    work.wind_bound[i] = scale * pressing;
    // Force and arm both turn: twice the force for a plate's, three times for |u_n| u_n, the arm alone for a sphere.
    const T turns = plan.kind[i] == Kind::branch ? T(3) : is_flat(plan.kind[i]) ? T(2) : T(1);
    work.turn_bound[i] = turns * scale * pressing * wind.norm();
    if (!is_foliage(plan.kind[i])) return;
    const bool leaf = plan.leaf.on && is_flat(plan.kind[i]);
    damp_spin<T>(plan, own, state, work, i,
                 spin_rate(plan.kind[i], scale, plan.mass[i], Vector3<T>(wind - v)) + (leaf ? plan.leaf.across : T(0)),
                 turning);
    if (leaf) leaf_in_wind<T>(plan, own, state, work, i, wind, wind - v);
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

template void external_forces(const Plan<float>&, const AnalyticPlan<float>&, State<float>&, AnalyticWork<float>&,
                              double);
template void external_forces(const Plan<double>&, const AnalyticPlan<double>&, State<double>&, AnalyticWork<double>&,
                              double);

} // namespace bough
