#include "energy_guard.h"
#include "../laws/air_load.h"
#include "../plan/body_air.h"
#include "../plan/pushes.h"
#include "midpoint.h"
#include "turn_bounds.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

constexpr double tolerance = 1e-3; // of the kinetic energy

// Kinetic energy's bilinear form over one body: velocities at its joint, c its centre of mass from there.
template <class T>
double kinetic(const Plan<T>& plan, const State<T>& s, std::size_t i, const Vector3<T>& v1, const Vector3<T>& w1,
               const Vector3<T>& v2, const Vector3<T>& w2) {
    const Vector3<T> c = s.R_wb[i] * plan.com[i];
    const Vector3<T> b1 = s.R_wb[i].transpose() * w1, b2 = s.R_wb[i].transpose() * w2;
    const T moment = (v1.dot(w2.cross(c)) + v2.dot(w1.cross(c))) / 2;
    return double(plan.mass[i] * (v1.dot(v2) / 2 + moment) + b1.dot(plan.inertia_joint[i] * b2) / 2);
}

template <class T> double elastic(const Plan<T>& plan, std::size_t i, const Vector3<T>& theta) {
    return double(theta.dot(plan.K[i].cwiseProduct(theta)) / 2);
}

// The joint's own angular velocity, world.
template <class T> Vector3<T> joint_spin(const State<T>& s, std::size_t i) {
    return s.R_wb[i] * (body_rate_jacobian(s.theta[i]) * s.theta_dot[i]);
}

// By its joint alone.
template <class T> double own_kinetic(const Plan<T>& plan, const State<T>& s, std::size_t i) {
    const Vector3<T> rate = body_rate_jacobian(s.theta[i]) * s.theta_dot[i];
    return double(rate.dot(plan.inertia_joint[i] * rate) / 2);
}

// The pulls' work on wood, from their points at the start (sign 1) to those at the end (-1), as seen from the ground; at the end
// their forces on ends of branches.
template <class T> void book_pulls(const Plan<T>& plan, State<T>& s, CoupledWork<T>& work, double time, double sign) {
    visit_pushes(plan, s, time + plan.dt / 2, [&](std::size_t body, const Vector3<T>& point_b, const Vector3<T>& f) {
        if (is_end(plan, body) && sign > 0) work.guard[body].push += f;
        Vector3<T> point = s.x_w[body] + s.R_wb[body] * point_b;
        const GroundStep<T>* ground = ground_step_of(plan, work, body);
        if (ground && sign < 0) point -= carried_by(*ground, T(plan.dt));
        work.account[work.guard[body].tree].gained +=
            sign * f.template cast<double>().dot(point.template cast<double>());
    });
}

template <class T> void start_of(const Plan<T>& plan, State<T>& s, CoupledWork<T>& work, std::size_t i) {
    GuardBody<T>& b = work.guard[i];
    EnergyAccount& account = work.account[b.tree];
    b.joint = s.x_w[i];
    b.com = s.x_w[i] + s.R_wb[i] * plan.com[i];
    b.v.setZero();
    b.omega.setZero();
    b.push.setZero();
    Matrix3<T> host = Matrix3<T>::Identity();
    if (plan.parent[i] >= 0) {
        const auto p = std::size_t(plan.parent[i]);
        host = s.R_wb[p];
        b.omega = work.guard[p].omega;
        b.v = work.guard[p].v + b.omega.cross(Vector3<T>(s.x_w[i] - s.x_w[p]));
    }
    if (is_end(plan, i)) {
        b.arm = host.transpose() * (b.com - b.joint);
        b.carried = b.v + b.omega.cross(Vector3<T>(b.com - b.joint));
        b.host_omega = b.omega;
        b.own = own_kinetic(plan, s, i) + elastic(plan, i, s.theta[i]);
    }
    b.omega += joint_spin(s, i);
    account.kinetic += kinetic(plan, s, i, b.v, b.omega, b.v, b.omega);
    account.gained -= elastic(plan, i, s.theta[i]);
}

} // namespace

template <class T> bool weigh_start(const Plan<T>& plan, State<T>& s, CoupledWork<T>& work, double time) {
    for (EnergyAccount& account : work.account) account = {};
    std::uint32_t trees = 0;
    bool any = false;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        GuardBody<T>& b = work.guard[i];
        b.tree = plan.parent[i] < 0 ? trees++ : work.guard[std::size_t(plan.parent[i])].tree;
        const T limit = T((is_end(plan, i) ? watched_end_turn : watched_turn) / plan.dt);
        const Vector3<T> rate = s.theta_dot[i] + work.theta_dot_change[i];
        if (!(work.coupled[i].omega.squaredNorm() > limit * limit || rate.squaredNorm() > limit * limit)) continue;
        if (turns(ground_step_of(plan, work, i))) continue;
        work.account[b.tree].watched = any = true;
        if (!is_end(plan, i)) work.account[b.tree].wood = true;
    }
    if (!any) return false;
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (work.account[work.guard[i].tree].watched) start_of(plan, s, work, i);
    book_pulls(plan, s, work, time, 1);
    return true;
}

namespace {

// Work [J] of the air on a body that moved so far, `own` of it as seen from what carries it. What the linear model has beyond the most that the
// air can do (air_work_bound) is its error.
template <class T>
double air_work(const Plan<T>& plan, const State<T>& s, const CoupledWork<T>& work, std::size_t i,
                const Vector3<T>& moved, const Vector3<T>& own) {
    const CoupledBody<T>& y = work.coupled[i];
    const Vector3<T> mean = moved / T(plan.dt), carried = (moved - own) / T(plan.dt);
    const Vector3<T> U = wind_on_body_at(plan, i, s.wind, Vector3<T>(y.x + y.c)) - carried;
    const Vector3<T> ahead = mean - y.v - y.omega.cross(y.c);
    const T limit =
        air_work_bound(air_body<T>(plan, i), plan.leaf, T(plan.dt), U, Vector3<T>(U + carried - mean).norm());
    return double(std::min((y.air - y.D * ahead).dot(own), limit));
}

template <class T>
void weigh_end_of_branch(const Plan<T>& plan, State<T>& s, CoupledWork<T>& work, std::size_t i, const Vector3<T>& own,
                         const Vector3<T>& g) {
    GuardBody<T>& b = work.guard[i];
    const T h = T(plan.dt), m = plan.mass[i];
    const Vector3<T> c = s.R_wb[i] * plan.com[i], moved = s.x_w[i] + c - b.com;
    Vector3<T> arm = b.arm;
    if (plan.parent[i] >= 0) arm = s.R_wb[std::size_t(plan.parent[i])] * b.arm;
    const Vector3<T> omega = b.omega + b.omega_fast, v = b.v + b.v_fast; // of what carries it
    const Vector3<T> spin = joint_spin(s, i);
    const Vector3<T> by_itself = c - arm;
    const Vector3<T> a = (v + omega.cross(arm) - b.carried) / h;
    b.keep = 1;
    if (b.push.isZero(0) && (omega + spin).norm() * h > T(watched_end_turn)) {
        const Matrix3<T> I =
            s.R_wb[i] * plan.inertia_joint[i] * s.R_wb[i].transpose() + m * cross_matrix(c) * cross_matrix(c);
        const double now = own_kinetic(plan, s, i);
        double booked = double(m * (g - a).dot(by_itself)) - double((I * (omega - b.host_omega)).dot(spin));
        if (plan.wind) booked += air_work(plan, s, work, i, moved, by_itself);
        const double excess = now + elastic(plan, i, s.theta[i]) - b.own - booked;
        if (excess > tolerance * now) b.keep = T(std::sqrt(std::max(0.0, 1 - excess / now)));
    }
    // In the tree's balance with what it keeps.
    EnergyAccount& account = work.account[b.tree];
    b.omega += b.keep * spin;
    account.slow += kinetic(plan, s, i, b.v, b.omega, b.v, b.omega);
    account.mixed += kinetic(plan, s, i, b.v, b.omega, b.v_fast, b.omega_fast);
    account.fast += kinetic(plan, s, i, b.v_fast, b.omega_fast, b.v_fast, b.omega_fast);
    account.gained += elastic(plan, i, s.theta[i]) - double(m * g.dot(own));
    if (plan.wind) account.gained -= air_work(plan, s, work, i, moved, own);
}

template <class T> void weigh_end(const Plan<T>& plan, State<T>& s, CoupledWork<T>& work, std::size_t i) {
    GuardBody<T>& b = work.guard[i];
    EnergyAccount& account = work.account[b.tree];
    const Vector3<T> c = s.R_wb[i] * plan.com[i], moved = s.x_w[i] + c - b.com;
    b.v = b.omega = b.v_fast = b.omega_fast = Vector3<T>::Zero();
    if (plan.parent[i] >= 0) {
        const GuardBody<T>& p = work.guard[std::size_t(plan.parent[i])];
        const Vector3<T> arm = s.x_w[i] - s.x_w[std::size_t(plan.parent[i])];
        b.omega = p.omega;
        b.omega_fast = p.omega_fast;
        b.v = p.v + p.omega.cross(arm);
        b.v_fast = p.v_fast + p.omega_fast.cross(arm);
    }
    Vector3<T> own = moved, g = plan.scene.gravity.template cast<T>();
    if (const GroundStep<T>* ground = ground_step_of(plan, work, i)) {
        own -= carried_by(*ground, T(plan.dt));
        g -= ground->a;
    }
    if (is_end(plan, i)) return weigh_end_of_branch(plan, s, work, i, own, g);
    const Vector3<T> spin = joint_spin(s, i);
    b.fast = (b.omega + b.omega_fast + spin).norm() * T(plan.dt) > T(watched_turn);
    (b.fast ? b.omega_fast : b.omega) += spin;
    account.slow += kinetic(plan, s, i, b.v, b.omega, b.v, b.omega);
    account.mixed += kinetic(plan, s, i, b.v, b.omega, b.v_fast, b.omega_fast);
    account.fast += kinetic(plan, s, i, b.v_fast, b.omega_fast, b.v_fast, b.omega_fast);
    account.gained += elastic(plan, i, s.theta[i]) - double(plan.mass[i] * g.dot(own));
    if (plan.wind) account.gained -= air_work(plan, s, work, i, moved, own);
}

} // namespace

void settle(EnergyAccount& a, bool foliage) {
    if (!a.wood) return;
    const double now = a.slow + 2 * a.mixed + a.fast, excess = now - a.kinetic + a.gained;
    if (!(excess > tolerance * now)) return;
    const double target = now - excess;
    // The largest x in [0, 1] with slow + 2 x mixed + x^2 fast = target, or where that is least.
    const double least = a.fast > 0 ? std::clamp(-a.mixed / a.fast, 0.0, 1.0) : 0;
    const double at_least = a.slow + 2 * least * a.mixed + least * least * a.fast;
    if (at_least < target) {
        const double root = std::sqrt(std::max(0.0, a.mixed * a.mixed - a.fast * (a.slow - target)));
        a.keep_fast = std::clamp((root - a.mixed) / a.fast, 0.0, 1.0);
        return;
    }
    a.keep_fast = least;
    if (foliage && !(a.fast > 0.01 * a.slow)) return;
    a.keep_slow = at_least > 0 ? std::sqrt(std::max(0.0, target) / at_least) : 1;
    a.keep_fast *= a.keep_slow;
}

template <class T> void guard_energy(const Plan<T>& plan, State<T>& s, CoupledWork<T>& work, double time) {
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (work.account[work.guard[i].tree].watched) weigh_end(plan, s, work, i);
    book_pulls(plan, s, work, time, -1);
    const auto book = [&](std::size_t body, double done) {
        work.guard[body].keep = 1;
        work.account[work.guard[body].tree].gained -= std::max(0.0, done);
    };
    for (const Attached& held : work.attachments.all) {
        book(held.body, held.work);
        if (held.far) book(held.far->body, held.far_work);
    }
    for (const PulledPoint& point : work.attachments.pulled)
        if (point.turns) book(point.body, point.work);
    for (EnergyAccount& account : work.account)
        if (account.watched) settle(account, plan.foliage);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const EnergyAccount& account = work.account[work.guard[i].tree];
        if (!account.watched) continue;
        double keep = work.guard[i].fast ? account.keep_fast : account.keep_slow;
        if (is_end(plan, i)) keep = double(work.guard[i].keep) * account.keep_slow;
        if (!(keep < 1)) continue;
        s.theta_dot[i] *= T(keep);
        work.theta_change[i] = T(plan.dt) * s.theta_dot[i];
        work.theta_dot_change[i].setZero();
        ++s.flags.energy_guard;
    }
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template bool weigh_start(const Plan<T>&, State<T>&, CoupledWork<T>&, double);                                     \
    template void guard_energy(const Plan<T>&, State<T>&, CoupledWork<T>&, double);
#include "../base/instantiate.inc"

} // namespace bough
