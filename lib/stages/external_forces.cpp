#include "external_forces.h"
#include "../base/parallel.h"
#include "air.h"
#include "leaf_air.h"
#include "root_term.h"
#include "shelter.h"
#include <algorithm>

namespace bough {

Vec3 pull_force(const Pull& pull, double t) {
    if (pull.time.empty() || t < pull.time.front() || t > pull.time.back()) return Vec3::Zero();
    const auto after = std::upper_bound(pull.time.begin(), pull.time.end(), t);
    if (after == pull.time.end()) return pull.force.back();
    const auto k = std::size_t(after - pull.time.begin()) - 1;
    const double w = (t - pull.time[k]) / (pull.time[k + 1] - pull.time[k]);
    return (1 - w) * pull.force[k] + w * pull.force[k + 1];
}

namespace {

// What the air takes of a body's own turning, at `rate` (air.h, leaf_air.h). turning: its ground's.
template <class T>
void damp_spin(const Plan<T>& plan, State<T>& state, std::size_t i, T rate, const Vector3<T>& turning) {
    const Matrix3<T>& R = state.R_wb[i];
    const T m = plan.mass[i];
    const Vector3<T>& c = plan.com[i];
    const Matrix3<T> I = rate * central_inertia(m, plan.inertia_joint[i], c);
    const Vector3<T> omega = state.omega_w[i] - turning;
    state.tau_w[i] -= R * (I * (R.transpose() * turning));
    state.drag_tau_w[i] -= R * (I * (R.transpose() * omega));
    const T arm = std::max(plan.com_distance[i], T(1e-9));
    state.drag_bound[i] +=
        m * rate * (1 - c.squaredNorm() / (arm * arm)); // the rate times I is at most this times the arm's square
}

// still, moving: the air's velocity past the body at rest on its ground, and as it goes.
template <class T>
void leaf_in_wind(const Plan<T>& plan, State<T>& state, std::size_t i, const Vector3<T>& still,
                  const Vector3<T>& moving) {
    const Matrix3<T>& R = state.R_wb[i];
    const T m = plan.mass[i], scale = plan.drag_area[i], k = leaf_lever(plan.leaf, scale);
    const Vector3<T> c = R * plan.com[i];
    const Vector3<T> f = leaf_resistance(plan.leaf, m, R, still),
                     drag_f = leaf_resistance(plan.leaf, m, R, Vector3<T>(moving - still));
    const Vector3<T> at_rest = leaf_torque(plan.leaf, scale, R, still);
    state.f_w[i] += f;
    state.tau_w[i] += c.cross(f) + at_rest;
    state.drag_f_w[i] += drag_f;
    state.drag_tau_w[i] += c.cross(drag_f) + leaf_torque(plan.leaf, scale, R, moving) - at_rest;
    const T arm = std::max(plan.com_distance[i], T(1e-9)), speed = still.norm();
    state.drag_bound[i] += m * plan.leaf.most + k / arm * (moving.norm() + speed);
    state.wind_bound[i] += m * plan.leaf.most;
    state.turn_bound[i] += 2 * speed * (m * plan.leaf.most + k / arm * speed);
}

template <class T> void wind_on_body(const Plan<T>& plan, State<T>& state, std::size_t i) {
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
    state.f_w[i] = scale * still.force;
    state.tau_w[i] = arm.cross(state.f_w[i]);
    state.drag_f_w[i] = scale * (moving.force - still.force);
    state.drag_tau_w[i] = arm.cross(state.drag_f_w[i]);
    state.drag_bound[i] = scale * (moving.speed + still.speed);
    const T pressing = is_foliage(plan.kind[i]) ? still.speed : wind.norm();
    state.wind_bound[i] = scale * pressing;
    // Force and arm both turn: twice the force for a plate's, three times for |u_n| u_n, the arm alone for a sphere.
    const T turns = plan.kind[i] == Kind::branch ? T(3) : is_flat(plan.kind[i]) ? T(2) : T(1);
    state.turn_bound[i] = turns * scale * pressing * wind.norm();
    if (!is_foliage(plan.kind[i])) return;
    const bool leaf = plan.leaf.on && is_flat(plan.kind[i]);
    damp_spin<T>(plan, state, i,
                 spin_rate(plan.kind[i], scale, plan.mass[i], Vector3<T>(wind - v)) + (leaf ? plan.leaf.across : T(0)),
                 turning);
    if (leaf) leaf_in_wind<T>(plan, state, i, wind, wind - v);
}

} // namespace

template <class T> void external_forces(const Plan<T>& plan, State<T>& state, double time) {
    if (plan.wind) {
        parallel_for(plan.bodies, 50, [&](std::size_t i) { wind_on_body(plan, state, i); });
    } else {
        std::fill(state.f_w.begin(), state.f_w.end(), Vector3<T>::Zero());
        std::fill(state.tau_w.begin(), state.tau_w.end(), Vector3<T>::Zero());
    }
    visit_pushes(plan, state, time, [&](std::size_t body, const Vector3<T>& point_b, const Vector3<T>& f) {
        const Vector3<T> arm = state.R_wb[body] * point_b;
        state.f_w[body] += f;
        state.tau_w[body] += arm.cross(f);
    });
}

template void external_forces(const Plan<float>&, State<float>&, double);
template void external_forces(const Plan<double>&, State<double>&, double);

} // namespace bough
