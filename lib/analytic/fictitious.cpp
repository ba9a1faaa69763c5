#include "fictitious.h"
#include "../base/parallel.h"
#include "../plan/ground.h"

namespace bough {
namespace {

// How a joint's place on its parent moves: of a root's, on the ground.
template <class T> struct Carrier {
    Vector3<T> omega, alpha; // [rad/s], [rad/s^2]
    Vector3<T> a;            // [m/s^2] of the place
};

// The ground's, rigidly carried to x_w; at rest where it is not moved.
template <class T> Carrier<T> ground_carrier(const Plan<T>& plan, const State<T>& s, std::size_t i) {
    const Ground* ground = plan.root_motion ? ground_of(plan, s, i) : nullptr;
    if (!ground) return {Vector3<T>::Zero(), Vector3<T>::Zero(), Vector3<T>::Zero()};
    const Vec3 arm = s.x_w[i].template cast<double>() - ground->x;
    const Vec3 a = ground->a + ground->alpha.cross(arm) + ground->omega.cross(ground->omega.cross(arm));
    return {ground->omega.template cast<T>(), ground->alpha.template cast<T>(), a.template cast<T>()};
}

} // namespace

template <class T> void accelerations(const Plan<T>& plan, State<T>& s, AnalyticWork<T>& work) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        Carrier<T> base;
        if (plan.parent[i] < 0) {
            base = ground_carrier(plan, s, i);
        } else {
            const auto p = std::size_t(plan.parent[i]);
            const Vector3<T> r = s.x_w[i] - s.x_w[p], &omega = s.omega_w[p];
            base = {omega, work.alpha_w[p], work.a_w[p] + work.alpha_w[p].cross(r) + omega.cross(omega.cross(r))};
        }
        work.alpha_w[i] = base.alpha + s.R_wb[i] * work.spin_dot[i] + base.omega.cross(s.omega_w[i]);
        work.a_w[i] = base.a;
    }
}

template <class T> void fictitious_torques(const Plan<T>& plan, State<T>& s, AnalyticWork<T>& work) {
    const T A = T(plan.scene.fictitious->acceleration), turning = T(plan.scene.fictitious->turning),
            G = T(plan.scene.fictitious->gyroscopic);
    parallel_for(plan.bodies, 50, [&](std::size_t i) {
        work.fictitious_w[i].setZero();
        if (plan.mass[i] == 0) return; // broke off
        const Carrier<T> ground = ground_carrier(plan, s, i);
        const bool root = plan.parent[i] < 0;
        const auto p = std::size_t(plan.parent[i]);
        const Vector3<T>&omega_p = root ? ground.omega : s.omega_w[p], &alpha_p = root ? ground.alpha : work.alpha_w[p];
        const Matrix3<T>& J = work.c_J_w[i];
        const Vector3<T>& omega = s.omega_w[i];
        const Vector3<T> turned = alpha_p - ground.alpha + omega_p.cross(omega);
        const Vector3<T> whirled = omega.cross(J * omega) - ground.omega.cross(J * ground.omega);
        work.fictitious_w[i] = -A * work.c_h_w[i].cross(work.a_w[i] - ground.a) - turning * (J * turned) - G * whirled;
    });
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void accelerations(const Plan<T>&, State<T>&, AnalyticWork<T>&);                                          \
    template void fictitious_torques(const Plan<T>&, State<T>&, AnalyticWork<T>&);
#include "../base/instantiate.inc"

} // namespace bough
