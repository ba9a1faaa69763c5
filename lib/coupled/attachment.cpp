#include "attachment.h"
#include "../base/rotation_maps.h"
#include "../plan/attachment_course.h"
#include "attachment_paths.h"
#include "midpoint.h"
#include "pulled_points.h"
#include "turn_bounds.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace bough {
namespace {

// Of the path's own masses, by the rounding of zeta.
template <class T> constexpr double lost = std::is_same_v<T, float> ? 1e-2 : 1e-6;

// As midpoint.cpp, and where the joint is at y0.
void place_body(AttachedBody& b, const AttachedBody& p, bool halfway) {
    Vec3 half = b.now.theta_change / 2;
    b.x_start = p.x_start + p.R_start * b.joint_position;
    b.R_start = p.R_start * b.R_pj * rotation_from_vector<double>(b.now.theta);
    const Mat3 G = p.R * b.R_pj;
    if (!halfway || half.norm() > extrapolated_turn / 2 || Vec3(p.turn + G * half).norm() > extrapolated_turn)
        half.setZero();
    const RotationMaps<double> maps = rotation_maps<double>(b.now.theta + half);
    const Vec3 r = p.R * b.joint_position;
    b.R = G * maps.R;
    b.GJ = G * maps.J;
    b.r = r;
    b.x = p.x + r;
    b.turn = p.turn + b.GJ * half;
    b.own = p.own + b.GJ * b.now.eta;
    b.v = p.v + p.own.cross(r);
}

template <class T>
AttachedBody resting_ground(const Plan<T>& plan, const CoupledState<T>& work, std::size_t root, double time) {
    AttachedBody g;
    g.R_start.setIdentity();
    g.R.setIdentity();
    for (Vec3* v : {&g.x_start, &g.x, &g.turn, &g.own, &g.v}) v->setZero();
    const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, root) : -1;
    if (spline < 0) return g;
    const Ground start = ground_at(plan.splines[std::size_t(spline)], time);
    const GroundStep<T>& y = work.ground[std::size_t(spline)];
    g.R_start = start.R;
    g.x_start = start.x;
    g.R = y.R.template cast<double>();
    g.x = y.x.template cast<double>();
    return g;
}

// Where it is at the step's start and half a step on.
void place_end(const Attachments& a, AttachedEnd& end) {
    const AttachedBody& b = a.bodies[end.at];
    end.rho = b.R * end.point_b;
    end.start = b.x_start + b.R_start * end.point_b;
    end.velocity = b.v + b.own.cross(end.rho);
}

// F_ground of one end, times `of`.
template <class T>
void add_ground(const Plan<T>& plan, const CoupledState<T>& work, const Attached& held, const AttachedEnd& end,
                double of, Eigen::Matrix<double, 3, 4>& F) {
    const GroundStep<T>* ground = ground_step_of(plan, work, end.body);
    if (!ground) return;
    const GroundStep<T>& g = *ground;
    const Vec3 arm = work.attachments.bodies[end.at].x + end.rho - g.x.template cast<double>();
    const Vec3 a = g.a.template cast<double>() + g.alpha.template cast<double>().cross(arm);
    const Vec3 slope = g.slope_a.template cast<double>() + g.slope_alpha.template cast<double>().cross(arm);
    F.col(0) -= of * held.k * a;
    F.col(1) -= of * held.c * a;
    F.col(2) -= of * held.k * slope;
    F.col(3) -= of * held.c * slope;
}

template <class T> void add_ground(const Plan<T>& plan, CoupledState<T>& work, const Attached& held) {
    Eigen::Matrix<double, 3, 4> F = Eigen::Matrix<double, 3, 4>::Zero();
    add_ground(plan, work, held, held, 1, F);
    AttachmentSums& sums = work.attachments.bodies[held.at].sums;
    for (int k = 0; k < 4; ++k) {
        sums.F_ground[k] += F.col(k);
        sums.N_ground[k] += held.rho.cross(F.col(k));
    }
}

template <class T> void load_pair(const Plan<T>& plan, const CoupledState<T>& work, const Attached& held, Tie& tie) {
    const AttachedEnd& far = *held.far;
    const Vec3 velocity = held.velocity - far.velocity;
    tie.F = held.k * (held.start - far.start - (held.from_target + held.to_target) / 2) +
            held.c * (velocity - held.target_velocity);
    tie.slope = -held.k * (held.to_target - held.from_target) - held.c * held.quicker;
    tie.rate = held.k * velocity;
    tie.ground.setZero();
    add_ground(plan, work, held, held, 1, tie.ground);
    add_ground(plan, work, held, far, -1, tie.ground);
}

void add_point(AttachmentSums& sums, const Attached& held) {
    const Vec3& rho = held.rho;
    const Mat3 Q = rho.squaredNorm() * Mat3::Identity() - rho * rho.transpose();
    sums.A_stiffness += held.k * Q;
    sums.A_damping += held.c * Q;
    sums.B_stiffness += held.k * rho;
    sums.B_damping += held.c * rho;
    sums.stiffness += held.k;
    sums.damping += held.c;
    const Vec3 F = held.k * (held.start - (held.from_target + held.to_target) / 2) +
                   held.c * (held.velocity - held.target_velocity);
    const Vec3 slope = -held.k * (held.to_target - held.from_target) - held.c * held.quicker;
    const Vec3 rate = held.k * held.velocity;
    sums.F += F;
    sums.F_slope += slope;
    sums.F_rate += rate;
    sums.N += rho.cross(F);
    sums.N_slope += rho.cross(slope);
    sums.N_rate += rho.cross(rate);
}

void clear(AttachmentSums& s) {
    s.A_stiffness.setZero();
    s.A_damping.setZero();
    s.stiffness = s.damping = 0;
    for (Vec3* v : {&s.B_stiffness, &s.B_damping, &s.N, &s.N_slope, &s.N_rate, &s.F, &s.F_slope, &s.F_rate})
        v->setZero();
    for (int k = 0; k < 4; ++k) {
        s.N_ground[k].setZero();
        s.F_ground[k].setZero();
    }
}

// Stiffness and damping as they are taken: what digits can bear.
template <class T>
void take_softer(const Plan<T>& plan, const Attachments& a, Attached& held, std::complex<double> s1) {
    PathAnswer answer = path_answer(plan, a, held, s1);
    if (held.far) {
        const PathAnswer far = path_answer(plan, a, *held.far, s1);
        answer = {std::min(answer.mass, far.mass), std::min(answer.push, far.push)};
    }
    const double digits = 1 / std::sqrt(double(std::numeric_limits<T>::epsilon())),
                 most = std::sqrt(lost<T>) * digits * answer.mass;
    held.k = std::min(held.stiffness, most / std::norm(s1));
    held.c = std::min(held.damping, most / std::abs(s1));
    if (!(held.k < held.stiffness)) return;
    const double force = held.spring.norm(), bearable = digits * answer.push / std::norm(s1);
    const Vec3 longer = (1 / held.k - 1 / held.stiffness) * std::min(1.0, bearable / force) * held.spring;
    held.from_target += longer;
    held.to_target += longer;
}

} // namespace

template <class T> void begin_attachments(const Plan<T>& plan, CoupledState<T>& work) {
    Attachments& a = work.attachments;
    a = {};
    a.all = planned_attachments(plan);
    for (const auto* pulls : {&plan.pulls, &plan.followers})
        for (const PlannedPull<T>& pull : *pulls) {
            PulledPoint point{};
            point.body = pull.body;
            point.point_b = pull.point_b.template cast<double>();
            point.source = pull.source;
            point.turns = pulls == &plan.followers;
            a.pulled.push_back(point);
        }
    find_bodies(plan, a);
    for (AttachedBody& b : a.bodies) {
        b.now = {plan.theta_start[b.body].template cast<double>(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        AttachedBody ground;
        if (b.parent < 0) ground = resting_ground(plan, work, b.body, 0);
        place_body(b, b.parent < 0 ? ground : a.bodies[std::size_t(b.parent)], false);
    }
    const auto place_of = [&](const AttachedEnd& end) {
        const AttachedBody& b = a.bodies[end.at];
        return Vec3(b.x_start + b.R_start * end.point_b);
    };
    for (Attached& held : a.all)
        held.target = target_at_start(plan, held, place_of(held), held.far ? place_of(*held.far) : Vec3(Vec3::Zero()));
}

template <class T>
std::uint64_t attach(const Plan<T>& plan, CoupledState<T>& work, std::size_t body, const Vec3& point_b,
                     double stiffness, double damping, const Vec3& target) {
    Attachments& a = work.attachments;
    constexpr double ever = std::numeric_limits<double>::infinity();
    Attached held{};
    held.number = ++a.numbers;
    held.planned = -1;
    held.body = body;
    held.point_b = point_b;
    held.stiffness = stiffness;
    held.damping = damping;
    held.from = -ever;
    held.to = ever;
    held.target = target;
    a.all.push_back(held);
    find_bodies(plan, a);
    return held.number;
}

Attached* attached(Attachments& a, std::uint64_t number) {
    if (number == 0) return nullptr;
    const auto found =
        std::find_if(a.all.begin(), a.all.end(), [number](const Attached& held) { return held.number == number; });
    return found == a.all.end() ? nullptr : &*found;
}

template <class T> void adopt(const Plan<T>& plan, CoupledState<T>& work, const Attached& hand, std::size_t body) {
    Attachments& a = work.attachments;
    a.all.push_back(hand);
    Attached& held = a.all.back();
    held.body = body;
    held.force = held.spring = Vec3::Zero();
    a.numbers = std::max(a.numbers, hand.number);
    find_bodies(plan, a);
}

template <class T> void release(const Plan<T>& plan, CoupledState<T>& work, std::uint64_t number) {
    std::erase_if(work.attachments.all, [number](const Attached& held) { return held.number == number; });
    find_bodies(plan, work.attachments);
}

template <class T>
void release_from(const Plan<T>& plan, CoupledState<T>& work, const std::vector<std::size_t>& bodies) {
    Attachments& a = work.attachments;
    if (!a.any()) return;
    const auto gone = [&](std::size_t body) { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); };
    std::erase_if(a.all, [&](const Attached& held) { return gone(held.body) || (held.far && gone(held.far->body)); });
    std::erase_if(a.pulled, [&](const PulledPoint& point) { return gone(point.body); });
    find_bodies(plan, a);
}

template <class T> void read_attached(const State<T>& state, CoupledState<T>& work) {
    for (AttachedBody& b : work.attachments.bodies)
        b.now = {state.theta[b.body].template cast<double>(), state.theta_dot[b.body].template cast<double>(),
                 work.theta_change[b.body].template cast<double>(),
                 work.theta_dot_change[b.body].template cast<double>()};
}

template <class T>
void place_attachments(const Plan<T>& plan, const CoupledPlan<T>& own, CoupledState<T>& work, double time) {
    Attachments& a = work.attachments;
    const RationalScheme& scheme = scheme_of(own.scheme);
    for (AttachedBody& b : a.bodies) {
        if (b.parent < 0)
            place_body(b, resting_ground(plan, work, b.body, time), scheme.extrapolates);
        else
            place_body(b, a.bodies[std::size_t(b.parent)], scheme.extrapolates);
        clear(b.sums);
    }
    std::complex<double> s1 = plan.dt / scheme.pole[0].p;
    for (int k = 1; k < scheme.poles; ++k)
        if (const auto other = plan.dt / scheme.pole[std::size_t(k)].p; std::abs(other) > std::abs(s1)) s1 = other;
    auto tie = a.ties.begin();
    for (Attached& held : a.all) {
        Tie* const own_tie = held.far ? &*tie++ : nullptr;
        held.on = holds(held, time + plan.dt / 2);
        if (!held.on) {
            held.force = held.spring = Vec3::Zero();
            continue;
        }
        place_end(a, held);
        if (held.far) place_end(a, *held.far);
        lead(plan, held, time);
        take_softer(plan, a, held, s1);
        if (held.far) {
            load_pair(plan, work, held, *own_tie);
        } else {
            add_point(a.bodies[held.at].sums, held);
            add_ground(plan, work, held);
        }
        add_direction(plan, a, held);
    }
    for (PulledPoint& point : a.pulled) {
        place_end(a, point);
        place_pull(plan, a, point, time);
    }
    add_directions(plan, a);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void begin_attachments(const Plan<T>&, CoupledState<T>&);                                                 \
    template std::uint64_t attach(const Plan<T>&, CoupledState<T>&, std::size_t, const Vec3&, double, double,          \
                                  const Vec3&);                                                                        \
    template void adopt(const Plan<T>&, CoupledState<T>&, const Attached&, std::size_t);                               \
    template void release(const Plan<T>&, CoupledState<T>&, std::uint64_t);                                            \
    template void release_from(const Plan<T>&, CoupledState<T>&, const std::vector<std::size_t>&);                     \
    template void read_attached(const State<T>&, CoupledState<T>&);                                                    \
    template void place_attachments(const Plan<T>&, const CoupledPlan<T>&, CoupledState<T>&, double);
#include "../base/instantiate.inc"

} // namespace bough
