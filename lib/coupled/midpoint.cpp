#include "midpoint.h"
#include "../base/resolved_turn.h"
#include "../base/rotation_maps.h"
#include "../laws/ground_course.h"
#include "turn_bounds.h"

namespace bough {

namespace {

// Half a step on. Where the ground jumps on the way the mean of both ends: what lasts but a moment is no velocity for a step.
Ground ground_halfway(const RootSpline& spline, const GroundCourse& c, double time, double h) {
    if (!c.jumps) return ground_at(spline, time + h / 2);
    Ground g;
    g.R = c.turned.isZero(0) ? c.start.R : Mat3(rotation_from_vector<double>(c.turned / 2) * c.start.R);
    g.omega = (c.start.omega + c.end.omega) / 2;
    const Vec3 arm = g.R * spline.pivot, before = c.start.x + c.start.R * spline.pivot,
               after = c.end.x + c.end.R * spline.pivot;
    g.x = (before + after) / 2 - arm;
    g.v = (c.v_0 + c.v_1) / 2 - g.omega.cross(arm);
    return g;
}

} // namespace

template <class T>
void ground_over_step(const Plan<T>& plan, const CoupledPlan<T>& own, CoupledState<T>& work, double time) {
    const double h = plan.dt;
    const bool halfway = scheme_of(own.scheme).extrapolates;
    for (std::size_t k = 0; k < plan.splines.size(); ++k) {
        GroundCourse c = ground_course(plan.splines[k], time, h);
        if (!halfway) c.slope = c.slope_turn = Vec3::Zero(); // order 1 makes one impulse of what is a pair
        const Ground y = halfway ? ground_halfway(plan.splines[k], c, time, h) : c.start;
        const Vec3 arm = y.R * plan.splines[k].pivot; // from the world's origin, as it is carried, to the pivot
        std::uint64_t seen = 0;                       // counted by midpoint()
        const Vec3 spin = resolved_turn(y.omega, h, seen);
        GroundStep<T>& g = work.ground[k];
        g.R = y.R.template cast<T>();
        g.x = y.x.template cast<T>();
        g.v = y.v.template cast<T>();
        g.omega = y.omega.template cast<T>();
        g.v_0 = (c.v_0 - c.start.omega.cross(arm)).template cast<T>();
        g.omega_0 = c.start.omega.template cast<T>();
        g.a = (c.a - c.alpha.cross(arm) - spin.cross(spin.cross(arm))).template cast<T>();
        g.alpha = c.alpha.template cast<T>();
        g.slope_a = (c.slope - c.slope_turn.cross(arm)).template cast<T>();
        g.slope_alpha = c.slope_turn.template cast<T>();
        g.jumps = c.jumps;
    }
}

namespace {

template <class T> CoupledBody<T> ground_body(const Plan<T>& plan, const CoupledState<T>& work, std::size_t i) {
    CoupledBody<T> b;
    b.R.setIdentity();
    for (Vector3<T>* v : {&b.x, &b.omega, &b.v, &b.omega_0, &b.v_0, &b.turn, &b.alpha_0, &b.a_0}) v->setZero();
    if (const GroundStep<T>* g = ground_step_of(plan, work, i)) {
        b.R = g->R;
        b.x = g->x;
        b.omega = g->omega;
        b.v = g->v;
        b.omega_0 = g->omega_0;
        b.v_0 = g->v_0;
    }
    return b;
}

template <class T>
void place_halfway(const Plan<T>& plan, State<T>& state, CoupledWork<T>& work, const CoupledBody<T>& p, std::size_t i,
                   bool halfway, std::uint64_t& fast) {
    CoupledBody<T>& b = work.coupled[i];
    const T h = T(plan.dt);
    Vector3<T> theta = state.theta[i], eta = state.theta_dot[i];
    Vector3<T> half_change = work.theta_change[i] / 2;
    const Vector3<T> half_turn = p.turn + p.R * (plan.R_pj[i] * half_change);
    if (half_change.norm() > T(extrapolated_turn / 2) || half_turn.norm() > T(extrapolated_turn)) halfway = false;
    if (halfway) {
        theta += half_change;
        eta += work.theta_dot_change[i] / 2;
    }
    const RotationMaps<T> maps = rotation_maps(theta);
    const Matrix3<T> G = p.R * plan.R_pj[i], GJ = G * maps.J;
    b.R = G * maps.R;
    b.rates = maps.J_inverse * G.transpose();
    b.r = p.R * plan.joint_position[i];
    b.x = p.x + b.r;
    b.c = b.R * plan.com[i];
    const Vector3<T> w = GJ * eta, w_0 = GJ * state.theta_dot[i];
    b.omega = p.omega + w;
    b.v = p.v + p.omega.cross(b.r);
    b.omega_0 = p.omega_0 + w_0;
    b.v_0 = p.v_0 + p.omega_0.cross(b.r);
    b.turn = p.turn;
    if (halfway) b.turn += GJ * half_change;
    const Vector3<T> spin = resolved_turn(p.omega, h, fast), turning = resolved_turn(w, h, fast);
    b.alpha_0 = p.alpha_0 + spin.cross(turning) + G * maps.rate_bias(resolved_turn(eta, h, fast));
    b.a_0 = p.a_0 + p.alpha_0.cross(b.r) + spin.cross(spin.cross(b.r));
}

} // namespace

template <class T> void midpoint(const Plan<T>& plan, State<T>& state, CoupledWork<T>& work, bool halfway) {
    std::uint64_t fast = 0;
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (plan.parent[i] < 0)
            place_halfway(plan, state, work, ground_body(plan, work, i), i, halfway, fast);
        else
            place_halfway(plan, state, work, work.coupled[std::size_t(plan.parent[i])], i, halfway, fast);
    state.flags.fast_turns += fast;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void ground_over_step(const Plan<T>&, const CoupledPlan<T>&, CoupledState<T>&, double);                   \
    template void midpoint(const Plan<T>&, State<T>&, CoupledWork<T>&, bool);
#include "../base/instantiate.inc"

} // namespace bough
