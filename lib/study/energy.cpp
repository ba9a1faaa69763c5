#include "energy.h"
#include "../analytic/analytic_stepper.h"
#include "../plan/ground.h"

namespace bough {

// Kinematics anew, in double: a float state's positions hold the rounding of every body on the way out, which over a deep
// chain is more than what the energies change by.
template <class T> std::vector<BodyMotion> body_motions(const Plan<T>& plan, const State<T>& s) {
    std::vector<BodyMotion> motion(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        BodyMotion& b = motion[i];
        const Vec3 theta = s.theta[i].template cast<double>(), d = plan.joint_position[i].template cast<double>();
        BodyMotion base;
        if (plan.parent[i] >= 0) {
            base = motion[std::size_t(plan.parent[i])];
        } else if (const Ground* ground = plan.root_motion ? ground_of(plan, s, i) : nullptr) {
            base = {ground->R, ground->x, ground->v, ground->omega};
        }
        const Vec3 arm = base.R * d;
        b.R = base.R * plan.R_pj[i].template cast<double>() * rotation_from_vector(theta);
        b.x = base.x + arm;
        b.v = base.v + base.omega.cross(arm);
        b.omega = base.omega + b.R * (body_rate_jacobian(theta) * s.theta_dot[i].template cast<double>());
    }
    return motion;
}

template <class T> Energy energy(const Plan<T>& plan, const State<T>& s) {
    Energy e;
    const std::vector<BodyMotion> motion = body_motions(plan, s);
    const auto* const joints = dynamic_cast<const AnalyticState<T>*>(&*s.own);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const BodyMotion& b = motion[i];
        const Vec3 w = b.R.transpose() * b.omega, u = b.R.transpose() * b.v, c = plan.com[i].template cast<double>();
        const Vec3 theta = s.theta[i].template cast<double>();
        const double m = double(plan.mass[i]);
        e.bodies += m * u.dot(u / 2 + w.cross(c)) + w.dot(plan.inertia_joint[i].template cast<double>() * w) / 2;
        if (joints) e.kinetic += joints->scaled_rate[i].template cast<double>().squaredNorm() / 2;
        e.elastic += theta.dot(plan.K[i].template cast<double>().cwiseProduct(theta)) / 2;
        e.potential -= m * plan.scene.gravity.dot(b.x + b.R * c);
    }
    if (!joints) e.kinetic = e.bodies;
    return e;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template std::vector<BodyMotion> body_motions(const Plan<T>&, const State<T>&);                                    \
    template Energy energy(const Plan<T>&, const State<T>&);
#include "../base/instantiate.inc"

} // namespace bough
