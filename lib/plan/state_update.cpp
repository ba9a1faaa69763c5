#include "state_update.h"
#include "ground.h"
#include "spring_torque.h"

namespace bough {

namespace {

// What a root's joint hangs on: the ground, where it is now.
template <class T> struct Base {
    Matrix3<T> R_wj;
    Vector3<T> x, omega, v; // of the joint's place
};

template <class T> Base<T> base_of(const Plan<T>& plan, const State<T>& s, std::size_t i) {
    const Ground* ground = plan.root_motion ? ground_of(plan, s, i) : nullptr;
    if (!ground) return {plan.R_pj[i], plan.joint_position[i], Vector3<T>::Zero(), Vector3<T>::Zero()};
    const Vec3 arm = ground->R * plan.joint_position[i].template cast<double>();
    return {Matrix3<T>((ground->R * plan.R_pj[i].template cast<double>()).template cast<T>()),
            Vec3(ground->x + arm).template cast<T>(), ground->omega.template cast<T>(),
            Vec3(ground->v + ground->omega.cross(arm)).template cast<T>()};
}

template <class T> void update_root(const Plan<T>& plan, State<T>& s, std::size_t i) {
    const Base<T> base = base_of(plan, s, i);
    s.R_wb[i] = base.R_wj * rotation_from_vector(s.theta[i]);
    s.x_w[i] = base.x;
    if (!plan.velocity) return;
    s.omega_w[i] = base.omega + s.R_wb[i] * (body_rate_jacobian(s.theta[i]) * s.theta_dot[i]);
    s.v_w[i] = base.v + s.omega_w[i].cross(Vector3<T>(s.R_wb[i] * plan.com[i]));
}

} // namespace

template <class T> void state_update(const Plan<T>& plan, State<T>& s) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        if (plan.parent[i] < 0) {
            update_root(plan, s, i);
            continue;
        }
        const auto p = std::size_t(plan.parent[i]);
        s.R_wb[i] = Matrix3<T>(s.R_wb[p] * plan.R_pj[i]) * rotation_from_vector(s.theta[i]);
        s.x_w[i] = s.x_w[p] + s.R_wb[p] * plan.joint_position[i];
        if (!plan.velocity) continue;
        const Vector3<T> spin = s.R_wb[i] * (body_rate_jacobian(s.theta[i]) * s.theta_dot[i]);
        s.omega_w[i] = s.omega_w[p] + spin;
        // The parent's v is its centre of mass'; the joint sits at d - com from there.
        const Vector3<T> to_joint = s.R_wb[p] * (plan.joint_position[i] - plan.com[p]);
        s.v_w[i] = s.omega_w[i].cross(Vector3<T>(s.R_wb[i] * plan.com[i]));
        s.v_w[i] += s.v_w[p] + s.omega_w[p].cross(to_joint);
    }
}

template <class T> void update_kinematics(const Plan<T>& plan, State<T>& state) {
    move_ground(plan, state, time_of(plan, state));
    if (!plan.pose) return;
    state_update(plan, state);
    if (plan.torque) spring_torque(plan, state);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void update_kinematics(const Plan<T>&, State<T>&);                                                        \
    template void state_update(const Plan<T>&, State<T>&);
#include "../base/instantiate.inc"

} // namespace bough
