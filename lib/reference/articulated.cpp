#include "articulated.h"
#include "../stages/air.h"
#include "../stages/external_forces.h"
#include <limits>

namespace bough {
namespace {

// [r]* X and X [r]*, column by column and row by row: half the work of the matrix products.
Mat3 cross_left(const Vec3& r, const Mat3& X) {
    Mat3 m;
    for (int k = 0; k < 3; ++k) m.col(k) = r.cross(X.col(k));
    return m;
}

// Kinematics and biases from the parent (the ground where there is none).
void place(const Plan<double>& plan, const ArticulatedBody* parent, ArticulatedBody& b, std::size_t i) {
    const Mat3 turn = rotation_from_vector(b.theta);
    if (!parent) {
        b.R_wb = plan.R_pj[i] * turn;
        b.x_w = b.r_w = plan.joint_position[i];
        b.omega_w = b.R_wb * b.rate;
        b.v_w = b.alpha_bias = b.a_bias = Vec3::Zero();
        return;
    }
    b.R_wb = parent->R_wb * plan.R_pj[i] * turn;
    b.r_w = parent->R_wb * plan.joint_position[i];
    b.x_w = parent->x_w + b.r_w;
    const Vec3 own = b.R_wb * b.rate, swing = parent->omega_w.cross(b.r_w);
    b.omega_w = parent->omega_w + own;
    b.v_w = parent->v_w + swing;
    b.alpha_bias = parent->alpha_bias + parent->omega_w.cross(own);
    b.a_bias = parent->a_bias + parent->alpha_bias.cross(b.r_w) + parent->omega_w.cross(swing);
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
void load(const Plan<double>& plan, const ArticulatedPass& pass, ArticulatedBody& b, std::size_t i, double h) {
    const Mat3 J = b.R_wb * plan.inertia_joint[i] * b.R_wb.transpose();
    const Vec3 c = b.R_wb * plan.com[i];
    const double m = plan.mass[i];
    const Vec3 a_com = b.a_bias + b.alpha_bias.cross(c) + b.omega_w.cross(b.omega_w.cross(c));
    b.A = J;
    b.A.diagonal().array() += 4 * std::numeric_limits<double>::epsilon() * J.trace();
    b.B = m * cross_matrix(c);
    b.M = m * Mat3::Identity();
    b.F = m * (a_com - plan.scene.gravity);
    b.N = J * b.alpha_bias + b.omega_w.cross(J * b.omega_w) + m * c.cross(b.a_bias - plan.scene.gravity);
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
    b.E = (sum / scale).inverse() / scale;
    b.u -= b.N;
    if (!parent) return;
    const Mat3 ZE = b.Z * b.E, EB = b.E * b.B;
    const Mat3 passed = ZE * b.A;
    const Mat3 A = (passed + passed.transpose()) / 2, B = ZE * b.B, M = b.M - b.B.transpose() * EB;
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
    if (plan.wind) evaluate_wind(*plan.scene.wind, time, pass.wind);
    std::vector<ArticulatedBody>& body = pass.body;
    const auto parent = [&](std::size_t i) {
        return plan.parent[i] < 0 ? nullptr : &body[std::size_t(plan.parent[i])];
    };
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        place(plan, parent(i), body[i], i);
        load(plan, pass, body[i], i, h);
    }
    add_pulls(plan, pass, time);
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
