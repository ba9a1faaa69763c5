#include "external_forces.h"
#include "air.h"
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

template <class T> void wind_on_body(const Plan<T>& plan, State<T>& state, std::size_t i) {
    const Matrix3<T>& R = state.R_wb[i];
    const Vector3<T> arm = R * plan.com[i];
    const Vector3<T> place = state.x_w[i] + arm;
    Vector3<T> wind = sheltered(plan, i, state.wind.at(place)), v = state.v_w[i];
    if (const Ground* ground = plan.root_motion ? ground_of(plan, state, i) : nullptr) {
        const Vec3 carried = ground->v + ground->omega.cross(place.template cast<double>() - ground->x);
        wind -= carried.template cast<T>();
        v -= carried.template cast<T>();
    }
    const AirForce<T> still = air_force(plan.kind[i], R, wind);
    const AirForce<T> moving = air_force(plan.kind[i], R, Vector3<T>(wind - v));
    const T scale = plan.drag_area[i];
    state.f_w[i] = scale * still.force;
    state.tau_w[i] = arm.cross(state.f_w[i]);
    state.drag_f_w[i] = scale * (moving.force - still.force);
    state.drag_tau_w[i] = arm.cross(state.drag_f_w[i]);
    state.drag_bound[i] = scale * (moving.speed + still.speed);
    state.wind_bound[i] = scale * wind.norm();
    // Force and arm both turn: twice the force for |u| (u.n), three times for |u_n| u_n, the arm alone for a sphere.
    const T turns = plan.kind[i] == Kind::branch ? T(3) : is_flat(plan.kind[i]) ? T(2) : T(1);
    state.turn_bound[i] = turns * scale * wind.squaredNorm();
}

} // namespace

template <class T> void external_forces(const Plan<T>& plan, State<T>& state, double time) {
    const auto n = std::int64_t(plan.bodies);
    if (plan.wind) {
#pragma omp parallel for schedule(static) if (n > 2000)
        for (std::int64_t i = 0; i < n; ++i) wind_on_body(plan, state, std::size_t(i));
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
