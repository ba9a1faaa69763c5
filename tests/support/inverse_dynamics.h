// inverse_dynamics.h: how well accelerations solve the equations of motion: the check that an articulated-body pass needs,
// because it can lose its digits on trees with extreme ratios of mass and stiffness and still look sane.
//
// The recursive Newton-Euler algorithm: outward the accelerations of all bodies from those of the joints, inward the wrenches
// they need; what the joint's spring does not provide of the moment is the residual, N_j - tau_j [N m].
// It has no elimination in it: an independent O(n) answer, backward stable.
#pragma once
#include "lib/laws/air_load.h"
#include "lib/plan/body_air.h"
#include "lib/plan/plan.h"
#include "lib/plan/pushes.h"
#include "lib/plan/state.h"

namespace bough {
namespace inverse {

struct Moving {
    Mat3 R;                        // world from body
    Vec3 x, r, omega, v, alpha, a; // own joint and the body at it
    Vec3 F, N;                     // what the joint must carry
    double moment = 0;             // size of the terms in N
};

inline Moving move(const Plan<double>& plan, const Moving& p, std::size_t i, const Vec3& theta, const Vec3& rate,
                   const Vec3& acceleration) {
    Moving b;
    b.R = p.R * plan.R_pj[i] * rotation_from_vector(theta);
    b.r = p.R * plan.joint_position[i];
    b.x = p.x + b.r;
    const Vec3 own = b.R * rate;
    b.omega = p.omega + own;
    b.alpha = p.alpha + b.R * acceleration + p.omega.cross(own);
    b.v = p.v + p.omega.cross(b.r);
    b.a = p.a + p.alpha.cross(b.r) + p.omega.cross(p.omega.cross(b.r));
    return b;
}

inline Moving ground_under(const Plan<double>& plan, std::size_t i, double time) {
    const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, i) : -1;
    const Ground g = spline < 0 ? Ground() : ground_at(plan.splines[std::size_t(spline)], time);
    Moving b;
    b.R = g.R;
    b.x = g.x;
    b.omega = g.omega;
    b.v = g.v;
    b.alpha = g.alpha;
    b.a = g.a;
    return b;
}

} // namespace inverse

struct Residual {
    double rms = 0, worst = 0; // [N m] over the joints
    double moment_rms = 0; // [N m] of the terms that cancel: own inertia, weight, air, spring, what hangs further out
    double relative() const { return moment_rms > 0 ? rms / moment_rms : 0; }
};

// Of `acceleration` (d rate / dt, body axes) at theta, rate (body axes), time. O(n).
inline Residual inverse_dynamics(const Plan<double>& plan, const std::vector<Vec3>& theta,
                                 const std::vector<Vec3>& rate, const std::vector<Vec3>& acceleration, double time) {
    using inverse::Moving;
    const std::size_t n = plan.bodies;
    const auto parent = [&](std::size_t i) { return std::size_t(plan.parent[i]); };
    WindTable<double> wind;
    if (plan.wind) {
        wind = make_wind_table<double>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
        evaluate_wind(*plan.scene.wind, time, wind);
    }
    std::vector<Moving> body(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Moving ground = plan.parent[i] < 0 ? inverse::ground_under(plan, i, time) : Moving();
        body[i] =
            inverse::move(plan, plan.parent[i] < 0 ? ground : body[parent(i)], i, theta[i], rate[i], acceleration[i]);
        Moving& b = body[i];
        const Mat3 J = b.R * plan.inertia_joint[i] * b.R.transpose();
        const Vec3 c = b.R * plan.com[i];
        const Vec3 a_com = b.a + b.alpha.cross(c) + b.omega.cross(b.omega.cross(c));
        const Vec3 inertial = J * b.alpha + b.omega.cross(J * b.omega) + plan.mass[i] * c.cross(b.a);
        const Vec3 weight = plan.mass[i] * plan.scene.gravity;
        Vec3 f = Vec3::Zero(), torque = Vec3::Zero();
        if (plan.wind) {
            const Vec3 u = wind_on_body_at(plan, i, wind, Vec3(b.x + c)) - b.v - b.omega.cross(c);
            const AirLoad<double> air = air_load(air_body<double>(plan, i), plan.leaf, b.R, u);
            f = air.force;
            torque = air.torque - air.spin * (central_inertia(plan.mass[i], J, c) * b.omega);
        }
        b.F = plan.mass[i] * a_com - weight - f;
        b.N = inertial - c.cross(weight + f) - torque;
        b.moment = inertial.norm() + c.cross(weight).norm() + c.cross(f).norm() + torque.norm();
    }
    const auto push = [&](const PlannedPull<double>& pull, const Mat3& axes) {
        Moving& b = body[pull.body];
        const Vec3 f = axes * pull_force(plan.scene.pulls[pull.source], time), arm = b.R * pull.point_b;
        b.F -= f;
        b.N -= arm.cross(f);
        b.moment += arm.cross(f).norm();
    };
    for (const PlannedPull<double>& pull : plan.pulls) push(pull, Mat3::Identity());
    for (const PlannedPull<double>& pull : plan.followers) push(pull, body[pull.body].R);
    Residual residual;
    double squares = 0, moments = 0;
    for (std::size_t i = n; i-- > 0;) {
        Moving& b = body[i];
        const Mat3 rates = body_rate_jacobian_inverse(theta[i]);
        const Vec3 theta_dot = rates * rate[i];
        const Vec3 tau = -b.R * (rates.transpose() * plan.K[i].cwiseProduct(Vec3(theta[i] + plan.beta[i] * theta_dot)));
        const double left = (b.N - tau).norm(), size = b.moment + tau.norm();
        squares += left * left;
        moments += size * size;
        residual.worst = std::max(residual.worst, left);
        if (plan.parent[i] < 0) continue;
        Moving& p = body[parent(i)];
        p.F += b.F;
        p.N += b.N + b.r.cross(b.F);
        p.moment += b.N.norm() + b.r.cross(b.F).norm();
    }
    residual.rms = std::sqrt(squares / double(n));
    residual.moment_rms = std::sqrt(moments / double(n));
    return residual;
}

} // namespace bough
