#include "articulated.h"
#include "../stages/air.h"
#include "../stages/external_forces.h"
#include <Eigen/Cholesky>
#include <limits>

namespace bough {
namespace {

// [r]* X and X [r]*, column by column and row by row: half the work of the matrix products.
Mat3 cross_left(const Vec3& r, const Mat3& X) {
    Mat3 m;
    for (int k = 0; k < 3; ++k) m.col(k) = r.cross(X.col(k));
    return m;
}

// Angular velocity as the terms quadratic in it take it: at most a radian a step.
Vec3 bounded(const Vec3& omega, double h, std::uint64_t& count) {
    const double turn = h * omega.norm();
    if (!(turn > 1)) return omega;
    ++count;
    return omega / turn;
}

// The ground as a body without mass, about the world's origin carried along.
ArticulatedBody ground_body(const Plan<double>& plan, const ArticulatedPass& pass, std::size_t i) {
    ArticulatedBody b;
    const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, i) : -1;
    const Ground ground = spline < 0 ? Ground() : pass.ground[std::size_t(spline)];
    b.R_wb = ground.R;
    b.x_w = ground.x;
    b.omega_w = ground.omega;
    b.v_w = ground.v;
    b.alpha_bias = ground.alpha;
    b.a_bias = ground.a;
    return b;
}

// Ground at the start of a step, with its mean acceleration over it.
void move_ground(const Plan<double>& plan, ArticulatedPass& pass, double time, double h) {
    for (std::size_t k = 0; k < plan.splines.size(); ++k) {
        Ground& ground = pass.ground[k];
        ground = ground_at(plan.splines[k], time);
        if (!(h > 0)) continue;
        const Ground end = ground_at(plan.splines[k], time + h);
        ground.a = (end.v - ground.v) / h;
        ground.alpha = (end.omega - ground.omega) / h;
    }
}

// Kinematics and biases from the parent.
void place(const Plan<double>& plan, const ArticulatedBody* parent, ArticulatedBody& b, std::size_t i, double h,
           std::uint64_t& fast) {
    b.R_wb = parent->R_wb * plan.R_pj[i] * rotation_from_vector(b.theta);
    b.r_w = parent->R_wb * plan.joint_position[i];
    b.x_w = parent->x_w + b.r_w;
    const Vec3 own = b.R_wb * b.rate;
    b.omega_w = parent->omega_w + own;
    b.v_w = parent->v_w + parent->omega_w.cross(b.r_w);
    const Vec3 spin = bounded(parent->omega_w, h, fast);
    b.alpha_bias = parent->alpha_bias + spin.cross(bounded(own, h, fast));
    b.a_bias = parent->a_bias + parent->alpha_bias.cross(b.r_w) + spin.cross(spin.cross(b.r_w));
}

void add_air(const Plan<double>& plan, const ArticulatedPass& pass, ArticulatedBody& b, std::size_t i, const Vec3& c,
             const Vec3& a_com, double h) {
    const Vec3 u = pass.wind.at(b.x_w.y() + c.y()) - b.v_w - b.omega_w.cross(c);
    Vec3 f = plan.drag_area[i] * air_force(plan.kind[i], b.R_wb, u).force;
    if (h > 0) {
        const Mat3 D = h * plan.drag_area[i] * air_damping(plan.kind[i], b.R_wb, u);
        const Mat3 cD = cross_left(c, D);
        b.M += D;
        b.B += cD;
        b.A += cross_left(c, cD.transpose()); // [c] D [c]^T
        f -= D * a_com;
        if (is_flat(plan.kind[i])) {
            const Mat3 turning = h * plan.drag_area[i] * c.norm() * air_turning(plan.kind[i], b.R_wb, u);
            b.A += h * turning;
            b.N += turning * (b.omega_w + h * b.alpha_bias);
        }
    }
    b.F -= f;
    b.N -= c.cross(f);
}

// The body's own inertia, bias wrench and spring.
void load(const Plan<double>& plan, const ArticulatedPass& pass, ArticulatedBody& b, std::size_t i, double h,
          std::uint64_t& fast) {
    const Mat3 J = b.R_wb * plan.inertia_joint[i] * b.R_wb.transpose();
    const Vec3 c = b.R_wb * plan.com[i];
    const double m = plan.mass[i];
    const Vec3 spin = bounded(b.omega_w, h, fast);
    const Vec3 a_com = b.a_bias + b.alpha_bias.cross(c) + spin.cross(spin.cross(c));
    b.A = J;
    b.A.diagonal().array() += 4 * std::numeric_limits<double>::epsilon() * J.trace();
    b.B = m * cross_matrix(c);
    b.M = m * Mat3::Identity();
    b.F = m * (a_com - plan.scene.gravity);
    b.N = J * b.alpha_bias + spin.cross(J * spin) + m * c.cross(b.a_bias - plan.scene.gravity);
    if (plan.wind) add_air(plan, pass, b, i, c, a_com, h);

    const Mat3 rates = body_rate_jacobian_inverse(b.theta) * b.R_wb.transpose(); // theta_dot from omega_w
    const Vec3 theta_dot = rates * (b.R_wb * b.rate);
    b.u = -rates.transpose() * plan.K[i].cwiseProduct(b.theta + (h + plan.beta[i]) * theta_dot);
    b.Z = h > 0 ? Mat3(rates.transpose() * (h * (h + plan.beta[i]) * plan.K[i]).asDiagonal() * rates)
                : Mat3(Mat3::Zero());
}

void add_pulls(const Plan<double>& plan, ArticulatedPass& pass, double time) {
    for (const PlannedPull<double>& pull : plan.pulls) {
        ArticulatedBody& b = pass.body[pull.body];
        const Vec3 f = pull_force(plan.scene.pulls[pull.source], time);
        b.F -= f;
        b.N -= (b.R_wb * pull.point_b).cross(f);
    }
}

// Eliminates the joint and hands the rest to the parent.
void eliminate(ArticulatedBody& b, ArticulatedBody* parent) {
    const Mat3 sum = b.A + b.Z;
    const double scale = sum.trace();
    const Mat3 L = (sum / scale).llt().matrixL();
    const Mat3 Li = L.triangularView<Eigen::Lower>().solve(Mat3(Mat3::Identity())) / std::sqrt(scale);
    b.E = Li.transpose() * Li;
    b.u -= b.N;
    if (!parent) return;
    const Mat3 ZE = b.Z * b.E, LB = Li * b.B;
    const Mat3 passed = ZE * b.A;
    const Mat3 A = (passed + passed.transpose()) / 2, B = ZE * b.B, M = b.M - LB.transpose() * LB;
    const Vec3 turn = b.E * b.u, F = b.F + b.B.transpose() * turn, N = b.N + b.A * turn;
    const Vec3& r = b.r_w;
    const Mat3 rM = cross_left(r, M), rB = cross_left(r, B.transpose()); // rB = [r] B^T
    parent->M += M;
    parent->B += B + rM;
    parent->A += A + rB + rB.transpose() + cross_left(r, rM.transpose()); // [r] M [r]^T
    parent->F += F;
    parent->N += N + r.cross(F);
}

void accelerate(ArticulatedBody& b, const ArticulatedBody* parent) {
    if (!parent) {
        b.a_w.setZero();
        b.alpha_w = b.joint_w = b.E * b.u;
        return;
    }
    b.a_w = parent->a_w + parent->alpha_w.cross(b.r_w);
    b.joint_w = b.E * (b.u - b.A * parent->alpha_w - b.B * b.a_w);
    b.alpha_w = parent->alpha_w + b.joint_w;
}

} // namespace

void articulated_pass(const Plan<double>& plan, ArticulatedPass& pass, double time, double h) {
    if (plan.wind) evaluate_wind(*plan.scene.wind, time + h, pass.wind);
    move_ground(plan, pass, time, h);
    std::vector<ArticulatedBody>& body = pass.body;
    const auto parent = [&](std::size_t i) {
        return plan.parent[i] < 0 ? nullptr : &body[std::size_t(plan.parent[i])];
    };
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        if (plan.parent[i] < 0) {
            const ArticulatedBody ground = ground_body(plan, pass, i);
            place(plan, &ground, body[i], i, h, pass.fast);
        } else {
            place(plan, parent(i), body[i], i, h, pass.fast);
        }
        load(plan, pass, body[i], i, h, pass.fast);
    }
    add_pulls(plan, pass, time + h);
    for (std::size_t i = plan.bodies; i-- > 0;) eliminate(body[i], parent(i));
    for (std::size_t i = 0; i < plan.bodies; ++i) accelerate(body[i], parent(i));
}

void joint_accelerations(const Plan<double>& plan, const std::vector<Vec3>& theta, const std::vector<Vec3>& rate,
                         double time, ArticulatedPass& work, std::vector<Vec3>& acceleration) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        work.body[i].theta = theta[i];
        work.body[i].rate = rate[i];
    }
    articulated_pass(plan, work, time, 0);
    acceleration.resize(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i)
        acceleration[i] = work.body[i].R_wb.transpose() * work.body[i].joint_w;
}

} // namespace bough
