#include "energy.h"
#include "state_update.h"

namespace bough {

template <class T> Energy energy(const Plan<T>& plan, const State<T>& given) {
    // A copy with velocities and present composites, which the run itself may not have.
    Plan<T> full = plan;
    full.velocity = true;
    full.forces = full.wind = false;
    State<T> s = given;
    s.omega_w.resize(plan.bodies);
    s.v_w.resize(plan.bodies);
    state_update(full, s);
    Energy e;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Vec3 theta = s.theta[i].template cast<double>();
        const Mat3 R = s.R_wb[i].template cast<double>();
        const Vec3 com = plan.com[i].template cast<double>();
        const Vec3 v = s.v_w[i].template cast<double>(), omega = R.transpose() * s.omega_w[i].template cast<double>();
        const double m = double(plan.mass[i]);
        const Mat3 c = cross_matrix(com);
        const Mat3 I = plan.inertia_joint[i].template cast<double>() + m * c * c;
        if (plan.solver == Solver::analytic) e.kinetic += s.scaled_rate[i].template cast<double>().squaredNorm() / 2;
        e.elastic += theta.dot(plan.K[i].template cast<double>().cwiseProduct(theta)) / 2;
        e.bodies += m * v.squaredNorm() / 2 + omega.dot(I * omega) / 2;
        e.potential -= m * plan.scene.gravity.dot(s.x_w[i].template cast<double>() + R * com);
    }
    if (plan.solver != Solver::analytic) e.kinetic = e.bodies;
    return e;
}

template Energy energy(const Plan<float>&, const State<float>&);
template Energy energy(const Plan<double>&, const State<double>&);

} // namespace bough
