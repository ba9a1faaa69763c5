#include "composite.h"
#include "../base/parallel.h"

namespace bough {
namespace {

template <class T>
void start_from_own_body(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& s, AnalyticWork<T>& work,
                         std::size_t i) {
    const Matrix3<T>& R = s.R_wb[i];
    work.c_h_w[i] = plan.mass[i] * (R * plan.com[i]);
    work.c_J_w[i] = R * plan.inertia_joint[i] * R.transpose();
    if (plan.forces) {
        work.c_f_w[i] = work.f_w[i];
        work.c_tau_w[i] = work.tau_w[i];
    }
    if (plan.wind) {
        work.c_drag_f_w[i] = work.drag_f_w[i];
        work.c_drag_tau_w[i] = work.drag_tau_w[i];
        const T arm = own.com_distance[i];
        work.c_drag[i] = work.drag_bound[i] * own.sway[i];
        work.c_wind[i] = work.wind_bound[i] * own.sway[i];
        work.c_turn[i] = work.turn_bound[i];
        work.c_drag_row[i] = work.c_drag[i] * arm;
        work.c_wind_row[i] = work.c_wind[i] * arm;
        work.c_turn_row[i] = work.c_turn[i] * arm;
    }
}

template <class T>
void add_to_parent(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& s, AnalyticWork<T>& work, std::size_t i,
                   std::size_t p) {
    const Vector3<T> r = s.R_wb[p] * plan.joint_position[i];
    const T m = plan.c_mass[i];
    const Vector3<T> q = work.c_h_w[i] + (m / 2) * r;
    work.c_h_w[p] += work.c_h_w[i] + m * r;
    const Matrix3<T> outer = r * q.transpose();
    work.c_J_w[p] += work.c_J_w[i] + 2 * r.dot(q) * Matrix3<T>::Identity() - outer - outer.transpose();
    if (plan.forces) {
        work.c_f_w[p] += work.c_f_w[i];
        work.c_tau_w[p] += work.c_tau_w[i] + r.cross(work.c_f_w[i]);
    }
    if (plan.wind) {
        work.c_drag_f_w[p] += work.c_drag_f_w[i];
        work.c_drag_tau_w[p] += work.c_drag_tau_w[i] + r.cross(work.c_drag_f_w[i]);
        const T way = own.joint_distance[i];
        work.c_drag[p] += work.c_drag[i];
        work.c_wind[p] += work.c_wind[i];
        work.c_turn[p] += work.c_turn[i];
        work.c_drag_row[p] += work.c_drag_row[i] + way * work.c_drag[i];
        work.c_wind_row[p] += work.c_wind_row[i] + way * work.c_wind[i];
        work.c_turn_row[p] += work.c_turn_row[i] + way * work.c_turn[i];
    }
}

} // namespace

template <class T>
void composite_update(const Plan<T>& plan, const AnalyticPlan<T>& own, State<T>& state, AnalyticWork<T>& work) {
    parallel_for(plan.bodies, 30, [&](std::size_t i) { start_from_own_body(plan, own, state, work, i); });
    for (std::size_t i = plan.bodies; i-- > 0;)
        if (plan.parent[i] >= 0) add_to_parent(plan, own, state, work, i, std::size_t(plan.parent[i]));
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void composite_update(const Plan<T>&, const AnalyticPlan<T>&, State<T>&, AnalyticWork<T>&);
#include "../base/instantiate.inc"

} // namespace bough
