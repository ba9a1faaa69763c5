#include "articulated.h"
#include "../base/resolved_turn.h"
#include "../laws/air_load.h"
#include "../plan/body_air.h"
#include "../plan/pushes.h"
#include <limits>

namespace bough {
namespace {

// Of the determinant of an inertia over its trace's cube: a rod of radius 1e-7 of its length has this.
constexpr double least_extent = 2e-15;

// [r]* X and X [r]*, column by column and row by row: half the work of the matrix products.
Mat3 cross_left(const Vec3& r, const Mat3& X) {
    Mat3 m;
    for (int k = 0; k < 3; ++k) m.col(k) = r.cross(X.col(k));
    return m;
}

// The ground as a body without mass, about the world's origin carried along.
ArticulatedBody ground_body(const Plan<double>& plan, const ArticulatedPass& pass, std::size_t i) {
    ArticulatedBody b;
    const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, i) : -1;
    const Ground ground = spline < 0 ? Ground() : pass.ground[std::size_t(spline)];
    const Mat3 R_bw = ground.R.transpose();
    b.R_wb = ground.R;
    b.x_w = ground.x;
    b.omega = R_bw * ground.omega;
    b.v = R_bw * ground.v;
    b.alpha = R_bw * ground.alpha;
    b.a = R_bw * ground.a;
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
void place_body(const Plan<double>& plan, const ArticulatedBody& parent, ArticulatedBody& b, std::size_t i, double h,
                std::uint64_t& fast) {
    const Vec3& r = plan.joint_position[i];
    b.R_pb = plan.R_pj[i] * rotation_from_vector(b.theta);
    b.R_wb = parent.R_wb * b.R_pb;
    b.x_w = parent.x_w + parent.R_wb * r;
    const Vec3 carried = b.R_pb.transpose() * parent.omega;
    b.omega = carried + b.rate;
    b.v = b.R_pb.transpose() * (parent.v + parent.omega.cross(r));
    const Vec3 spin = resolved_turn(parent.omega, h, fast);
    b.alpha_bias = (b.R_pb.transpose() * spin).cross(resolved_turn(b.rate, h, fast));
    b.a_bias = b.R_pb.transpose() * spin.cross(spin.cross(r));
}

void add_air(const Plan<double>& plan, const ArticulatedPass& pass, ArticulatedBody& b, std::size_t i,
             const Vec3& a_own, double h) {
    static const Mat3 own_axes = Mat3::Identity();
    AirBody<double> body = air_body<double>(plan, i);
    body.normal = b.R_wb.row(1); // the upright in own axes
    const Vec3& c = plan.com[i];
    Vec3 place = b.x_w;
    if (plan.field)
        place += b.R_wb * c;
    else
        place.y() += b.R_wb.row(1).dot(c);
    const Vec3 u = b.R_wb.transpose() * wind_on_body_at(plan, i, pass.wind, place) - b.v - b.omega.cross(c);
    const AirLoad<double> air = air_load(body, plan.leaf, own_axes, u);
    Vec3 f = air.force;
    if (air.spin > 0) {
        const Mat3 spin = air.spin * central_inertia(body.mass, plan.inertia_joint[i], c);
        b.N += spin * b.omega;
        b.A += h * spin;
    }
    b.N -= air.torque;
    if (h > 0) {
        const Mat3 D = air_load_damping(body, plan.leaf, own_axes, u, h), cD = cross_left(c, D);
        b.M += D;
        b.B += cD;
        b.A += cross_left(c, cD.transpose()); // [c] D [c]^T
        f -= D * a_own;
        // Of streaming in that solver alone: where it begins is a kink, which extrapolation feels.
        const Vec3 carried = pass.carried_drag.empty() ? Vec3(Vec3::Zero()) : pass.carried_drag[i];
        Mat3 turning = Mat3::Zero();
        add_air_turning(body, plan.leaf, own_axes, u, {plan.foliage, carried}, h, turning);
        b.A += h * turning;
        b.N += turning * b.omega;
    }
    b.F -= f;
    b.N -= c.cross(f);
}

// The body's own inertia about its joint; four roundings more where it has none about some axis.
Mat3 own_inertia(const Mat3& J) {
    const double size = J.trace();
    if (J.determinant() > least_extent * size * size * size) return J;
    return J + 4 * std::numeric_limits<double>::epsilon() * size * Mat3::Identity();
}

// The body's own inertia, bias wrench and spring.
void load(const Plan<double>& plan, const ArticulatedPass& pass, ArticulatedBody& b, std::size_t i, double h,
          std::uint64_t& fast) {
    const Mat3& J = plan.inertia_joint[i];
    const Vec3& c = plan.com[i];
    const double m = plan.mass[i];
    const Vec3 spin = resolved_turn(b.omega, h, fast), weight = m * (b.R_wb.transpose() * plan.scene.gravity);
    const Vec3 a_own = spin.cross(spin.cross(c));
    b.A = own_inertia(J);
    b.B = m * cross_matrix(c);
    b.M = m * Mat3::Identity();
    b.F = m * a_own - weight;
    b.N = spin.cross(J * spin) - c.cross(weight);
    if (plan.wind) add_air(plan, pass, b, i, a_own, h);

    const Mat3 T = body_rate_jacobian_inverse(b.theta);
    b.u = -T.transpose() * plan.K[i].cwiseProduct(b.theta + (h + plan.beta[i]) * (T * b.rate));
    b.Z = h > 0 ? Mat3(T.transpose() * (h * (h + plan.beta[i]) * plan.K[i]).asDiagonal() * T) : Mat3(Mat3::Zero());
}

void add_pulls(const Plan<double>& plan, ArticulatedPass& pass, double time) {
    for (const PlannedPull<double>& pull : plan.pulls) {
        ArticulatedBody& b = pass.body[pull.body];
        const Vec3 f = b.R_wb.transpose() * pull_force(plan.scene.pulls[pull.source], time);
        b.F -= f;
        b.N -= pull.point_b.cross(f);
    }
    for (const PlannedPull<double>& pull : plan.followers) {
        ArticulatedBody& b = pass.body[pull.body];
        const Vec3 f = pull_force(plan.scene.pulls[pull.source], time);
        b.F -= f;
        b.N -= pull.point_b.cross(f);
    }
}

// As forces, and in an implicit step with their change over it: h (h k + c) is a mass at the point. (Of those between two bodies each end has
// that mass by itself, the other going on as it moves: this pass closes no loop.)
void add_attachments(const Plan<double>& plan, ArticulatedPass& pass, double time, double h) {
    const auto push = [&](std::size_t body, const Vec3& p, const Vec3& f_w, double mass) {
        ArticulatedBody& b = pass.body[body];
        const Vec3 f = b.R_wb.transpose() * f_w, spun = b.omega.cross(b.omega.cross(p));
        b.M += mass * Mat3::Identity();
        b.B += mass * cross_matrix(p);
        b.A += mass * (p.squaredNorm() * Mat3::Identity() - p * p.transpose());
        b.F -= f - mass * spun;
        b.N -= p.cross(Vec3(f - mass * spun));
    };
    const auto motion = [&](std::size_t body, const Vec3& p) {
        const ArticulatedBody& b = pass.body[body];
        return CurvePoint{b.x_w + b.R_wb * p, b.R_wb * (b.v + b.omega.cross(p))};
    };
    for (std::size_t j = 0; j < plan.attachments.size(); ++j) {
        const PlannedAttachment& planned = plan.attachments[j];
        const Attachment& held = plan.scene.attachments[planned.source];
        if (!(held.from <= time && time < held.to)) continue;
        CurvePoint now = motion(planned.body, planned.point_b);
        if (planned.far) {
            const CurvePoint far = motion(planned.far->body, planned.far->point_b);
            now.x -= far.x;
            now.v -= far.v;
        }
        CurvePoint target{held.target.value_or(pass.attached_at[j])};
        if (planned.course) target = curve_at(*planned.course, time + h);
        const Vec3 f = held.stiffness * (target.x - now.x - h * now.v) + held.damping * (target.v - now.v);
        const double mass = h * (h * held.stiffness + held.damping);
        push(planned.body, planned.point_b, f, mass);
        if (planned.far) push(planned.far->body, planned.far->point_b, -f, mass);
    }
}

// L^-1 of S = L L^T, L lower triangular.
Mat3 inverse_factor(const Mat3& S) {
    const double i00 = 1 / std::sqrt(S(0, 0));
    const double l10 = S(1, 0) * i00, l20 = S(2, 0) * i00;
    const double i11 = 1 / std::sqrt(S(1, 1) - l10 * l10);
    const double l21 = (S(2, 1) - l20 * l10) * i11;
    const double i22 = 1 / std::sqrt(S(2, 2) - l20 * l20 - l21 * l21);
    const double m10 = -l10 * i00 * i11, m21 = -l21 * i11 * i22;
    const double m20 = -(l20 * i00 + l21 * m10) * i22;
    Mat3 m;
    m << i00, 0, 0, m10, i11, 0, m20, m21, i22;
    return m;
}

// Eliminates the joint and hands the rest to the parent, r: the joint in the parent's axes.
void eliminate(ArticulatedBody& b, ArticulatedBody* parent, const Vec3& r) {
    const Mat3 sum = b.A + b.Z;
    const Mat3 Li = inverse_factor(sum);
    b.E = Li.transpose() * Li;
    b.N += b.A * b.alpha_bias + b.B * b.a_bias;
    b.F += b.B.transpose() * b.alpha_bias + b.M * b.a_bias;
    const Vec3 torque = b.u;
    b.u -= b.N;
    if (!parent) return;
    const Mat3& R = b.R_pb;
    const Mat3 ZE = b.Z * b.E, ZEA = ZE * b.A, LB = Li * b.B, M_own = b.M - LB.transpose() * LB;
    const Vec3 turn = b.E * b.u;
    const Vec3 F = R * (b.F + b.B.transpose() * turn), N = R * (b.Z.isZero(0) ? torque : Vec3(b.N + b.A * turn));
    const Mat3 A = R * ((ZEA + ZEA.transpose()) / 2) * R.transpose();
    const Mat3 B = R * (ZE * b.B) * R.transpose(), M = R * M_own * R.transpose();
    const Mat3 rM = cross_left(r, M), rB = cross_left(r, B.transpose()); // rB = [r] B^T
    parent->M += M;
    parent->B += B + rM;
    parent->A += A + rB + rB.transpose() + cross_left(r, rM.transpose()); // [r] M [r]^T
    parent->F += F;
    parent->N += N + r.cross(F);
}

void accelerate(ArticulatedBody& b, const ArticulatedBody& parent, const Vec3& r) {
    const Vec3 alpha = b.R_pb.transpose() * parent.alpha;
    const Vec3 a = b.R_pb.transpose() * (parent.a + parent.alpha.cross(r));
    b.rate_dot = b.E * (b.u - b.A * alpha - b.B * a);
    b.alpha = alpha + b.alpha_bias + b.rate_dot;
    b.a = a + b.a_bias;
}

} // namespace

void articulated_pass(const Plan<double>& plan, ArticulatedPass& pass, double time, double h) {
    if (plan.wind) evaluate_wind(*plan.scene.wind, time + h, pass.wind);
    move_ground(plan, pass, time, h);
    std::vector<ArticulatedBody>& body = pass.body;
    const auto parent = [&](std::size_t i) {
        return plan.parent[i] < 0 ? nullptr : &body[std::size_t(plan.parent[i])];
    };
    const auto outward = [&](auto&& visit) {
        for (std::size_t i = 0; i < plan.bodies; ++i)
            if (const ArticulatedBody* p = parent(i))
                visit(i, *p);
            else
                visit(i, ground_body(plan, pass, i));
    };
    outward([&](std::size_t i, const ArticulatedBody& p) {
        place_body(plan, p, body[i], i, h, pass.fast);
        load(plan, pass, body[i], i, h, pass.fast);
    });
    add_pulls(plan, pass, time + h);
    add_attachments(plan, pass, time, h);
    for (std::size_t i = plan.bodies; i-- > 0;) eliminate(body[i], parent(i), plan.joint_position[i]);
    outward([&](std::size_t i, const ArticulatedBody& p) { accelerate(body[i], p, plan.joint_position[i]); });
}

} // namespace bough
