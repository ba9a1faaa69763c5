#include "state_update.h"

namespace bough {

template <class T> void state_update(const Plan<T>& plan, State<T>& s) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const std::int32_t parent = plan.parent[i];
        const auto p = std::size_t(parent);
        const Matrix3<T> R_wj = parent < 0 ? plan.R_pj[i] : Matrix3<T>(s.R_wb[p] * plan.R_pj[i]);
        s.R_wb[i] = R_wj * rotation_from_vector(s.theta[i]);
        s.x_w[i] = parent < 0 ? plan.joint_position[i] : Vector3<T>(s.x_w[p] + s.R_wb[p] * plan.joint_position[i]);
        if (!plan.velocity) continue;
        const Vector3<T> spin = s.R_wb[i] * (body_rate_jacobian(s.theta[i]) * s.theta_dot[i]);
        s.omega_w[i] = parent < 0 ? spin : Vector3<T>(s.omega_w[p] + spin);
        s.v_w[i] = s.omega_w[i].cross(Vector3<T>(s.R_wb[i] * plan.com[i]));
        if (parent < 0) continue;
        // The parent's v is its centre of mass'; the joint sits at d - com from there.
        const Vector3<T> to_joint = s.R_wb[p] * (plan.joint_position[i] - plan.com[p]);
        s.v_w[i] += s.v_w[p] + s.omega_w[p].cross(to_joint);
    }
}

template void state_update(const Plan<float>&, State<float>&);
template void state_update(const Plan<double>&, State<double>&);

} // namespace bough
