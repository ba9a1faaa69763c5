#include "composite.h"
#include "../base/parallel.h"

namespace bough {
namespace {

template <class T> void start_from_own_body(const Plan<T>& plan, State<T>& s, std::size_t i) {
    const Matrix3<T>& R = s.R_wb[i];
    s.c_h_w[i] = plan.mass[i] * (R * plan.com[i]);
    s.c_J_w[i] = R * plan.inertia_joint[i] * R.transpose();
    if (plan.forces) {
        s.c_f_w[i] = s.f_w[i];
        s.c_tau_w[i] = s.tau_w[i];
    }
    if (plan.wind) {
        s.c_drag_f_w[i] = s.drag_f_w[i];
        s.c_drag_tau_w[i] = s.drag_tau_w[i];
        const T arm = plan.com_distance[i];
        s.c_drag[i] = s.drag_bound[i] * plan.sway[i];
        s.c_wind[i] = s.wind_bound[i] * plan.sway[i];
        s.c_turn[i] = s.turn_bound[i];
        s.c_drag_row[i] = s.c_drag[i] * arm;
        s.c_wind_row[i] = s.c_wind[i] * arm;
        s.c_turn_row[i] = s.c_turn[i] * arm;
    }
}

template <class T> void add_to_parent(const Plan<T>& plan, State<T>& s, std::size_t i, std::size_t p) {
    const Vector3<T> r = s.R_wb[p] * plan.joint_position[i];
    const T m = plan.c_mass[i];
    const Vector3<T> q = s.c_h_w[i] + (m / 2) * r;
    s.c_h_w[p] += s.c_h_w[i] + m * r;
    const Matrix3<T> outer = r * q.transpose();
    s.c_J_w[p] += s.c_J_w[i] + 2 * r.dot(q) * Matrix3<T>::Identity() - outer - outer.transpose();
    if (plan.forces) {
        s.c_f_w[p] += s.c_f_w[i];
        s.c_tau_w[p] += s.c_tau_w[i] + r.cross(s.c_f_w[i]);
    }
    if (plan.wind) {
        s.c_drag_f_w[p] += s.c_drag_f_w[i];
        s.c_drag_tau_w[p] += s.c_drag_tau_w[i] + r.cross(s.c_drag_f_w[i]);
        const T way = plan.joint_distance[i];
        s.c_drag[p] += s.c_drag[i];
        s.c_wind[p] += s.c_wind[i];
        s.c_turn[p] += s.c_turn[i];
        s.c_drag_row[p] += s.c_drag_row[i] + way * s.c_drag[i];
        s.c_wind_row[p] += s.c_wind_row[i] + way * s.c_wind[i];
        s.c_turn_row[p] += s.c_turn_row[i] + way * s.c_turn[i];
    }
}

} // namespace

template <class T> void composite_update(const Plan<T>& plan, State<T>& state) {
    parallel_for(plan.bodies, 30, [&](std::size_t i) { start_from_own_body(plan, state, i); });
    for (std::size_t i = plan.bodies; i-- > 0;)
        if (plan.parent[i] >= 0) add_to_parent(plan, state, i, std::size_t(plan.parent[i]));
}

template void composite_update(const Plan<float>&, State<float>&);
template void composite_update(const Plan<double>&, State<double>&);

} // namespace bough
