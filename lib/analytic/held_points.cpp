#include "held_points.h"
#include "../base/cholesky.h"
#include "../base/rotation_maps.h"
#include "../plan/attachment_course.h"
#include "spring_joint.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double far_turn = 0.1; // [rad] that a change of force may ask a joint to turn by in a step
constexpr double least = 1e-300; // so that what is nothing can be divided by

// Where the path's joints are as theta says; the ground at `time`.
template <class T>
void place_points(const Plan<T>& plan, const std::vector<Vector3<T>>& theta, double time, HeldPoints<T>& of) {
    for (HeldJoint<T>& j : of.joints) {
        Mat3 R = Mat3::Identity();
        Vec3 x = Vec3::Zero();
        if (j.parent >= 0) {
            R = of.joints[std::size_t(j.parent)].R;
            x = of.joints[std::size_t(j.parent)].x;
        } else if (const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, j.body) : -1; spline >= 0) {
            const Ground ground = ground_at(plan.splines[std::size_t(spline)], time);
            R = ground.R;
            x = ground.x;
        }
        j.x = x + R * j.joint_position;
        j.R = R * j.R_pj * rotation_from_vector<double>(theta[j.body].template cast<double>());
    }
    each_end(of.all, [&](AttachedEnd& end) {
        const HeldJoint<T>& j = of.joints[end.at];
        end.rho = j.R * end.point_b;
        end.start = j.x + end.rho;
    });
}

// From an end to the ground: visit(joint, from its joint to the end, from its joint to the next or the end).
template <class Of, class Visit> void along(Of& of, const AttachedEnd& end, Visit&& visit) {
    Vec3 outward = end.start;
    for (auto k = std::int64_t(end.at); k >= 0; k = of.joints[std::size_t(k)].parent) {
        auto& j = of.joints[std::size_t(k)];
        visit(j, Vec3(end.start - j.x), Vec3(outward - j.x));
        outward = j.x;
    }
}
// Both ends of a pair; sign: of the force there.
template <class Of, class Visit> void along(Of& of, const Attached& held, Visit&& visit) {
    along(of, static_cast<const AttachedEnd&>(held),
          [&](auto& j, const Vec3& arm, const Vec3& P) { visit(j, 1.0, arm, P); });
    if (held.far) along(of, *held.far, [&](auto& j, const Vec3& arm, const Vec3& P) { visit(j, -1.0, arm, P); });
}

template <class T> void push(HeldPoints<T>& of, const Attached& held, const Vec3& f) {
    along(of, held,
          [&](HeldJoint<T>& j, double sign, const Vec3& arm, const Vec3&) { j.moment += arm.cross(sign * f); });
}
// Of the near point as seen from the far one.
template <class T> Vec3 way(const HeldPoints<T>& of, const Attached& held) {
    Vec3 sum = Vec3::Zero();
    along(of, held,
          [&](const HeldJoint<T>& j, double sign, const Vec3& arm, const Vec3&) { sum += sign * j.turn.cross(arm); });
    return sum;
}
template <class T> void clear_moments(HeldPoints<T>& of) {
    for (HeldJoint<T>& j : of.joints) j.moment.setZero();
}
template <class T> void turn_by_moments(HeldPoints<T>& of) {
    for (HeldJoint<T>& j : of.joints) j.turn = j.give * j.moment;
}

// (1/kappa + W) f = asked, W by `give` of the joints. Of what is not on, nothing.
template <class T, class Kappa> void solve(HeldPoints<T>& of, Kappa&& kappa) {
    of.answers.setZero();
    for (std::size_t m = 0; m < of.all.size(); ++m)
        for (int axis = 0; axis < 3; ++axis) {
            const auto column = 3 * Eigen::Index(m) + axis;
            of.answers(column, column) = 1;
            if (!of.all[m].on) continue;
            clear_moments(of);
            push(of, of.all[m], Vec3::Unit(axis));
            turn_by_moments(of);
            for (std::size_t n = 0; n < of.all.size(); ++n)
                if (of.all[n].on) of.answers.template block<3, 1>(3 * Eigen::Index(n), column) = way(of, of.all[n]);
            of.answers(column, column) += 1 / std::max(kappa(of.forces[m]), least);
        }
    of.factors->compute(of.answers);
    of.solved = of.factors->solve(of.asked);
}

Vec3 part(const Eigen::VectorXd& all, std::size_t k) {
    return all.segment<3>(3 * Eigen::Index(k));
}

// The joints' own answers to moments, and what they turn by without.
template <class T>
void answer(const Plan<T>& plan, const AnalyticPlan<T>& own, const State<T>& s, const AnalyticWork<T>& work,
            HeldPoints<T>& of) {
    for (HeldJoint<T>& j : of.joints) j.row = 0;
    const auto bound = [&](const AttachedEnd& end, double most) {
        double outboard = 0;
        along(of, end, [&](HeldJoint<T>& j, const Vec3&, const Vec3& P) {
            outboard += P.norm() * j.depth;
            j.row += most * outboard;
        });
    };
    for (std::size_t k = 0; k < of.all.size(); ++k) {
        if (!of.all[k].on) continue;
        bound(of.all[k], of.forces[k].most);
        if (of.all[k].far) bound(*of.all[k].far, of.forces[k].most);
    }
    for (HeldJoint<T>& j : of.joints) {
        SpringJoint<T> load = j.load;
        load.KG_b.diagonal().array() += T(j.row);
        const SpringOscillators<T> o = spring_oscillators(plan, own, s, work, load, j.body);
        const SpringTurn<T> turn = turn_of_modes(o, Vector3<T>(o.U.transpose() * load.residual_b),
                                                 Vector3<T>(o.X.transpose() * work.scaled_rate[j.body]));
        const Mat3 R = s.R_wb[j.body].template cast<double>(), U = R * o.U.template cast<double>();
        Vec3 E;
        for (int k = 0; k < 3; ++k) E[k] = double(o.ratio[k]) * double(o.step[k].E);
        j.L = o.L;
        j.give = U * E.asDiagonal() * U.transpose();
        j.turn = U * turn.dq.template cast<double>();
    }
}

// S_j^-1.
template <class T> void answer_to_impulses(HeldPoints<T>& of) {
    for (HeldJoint<T>& j : of.joints) {
        Mat3 inverse = j.R.transpose();
        solve_lower(Mat3(j.L.template cast<double>()), inverse);
        j.give = inverse.transpose() * inverse;
    }
}

// kappa and g by how stiff it is to the step.
template <class T> void weigh(const Plan<T>& plan, HeldPoints<T>& of, std::size_t k) {
    Attached& held = of.all[k];
    const double h = plan.dt;
    double mobility = 0; // tr V
    for (int axis = 0; axis < 3; ++axis) {
        clear_moments(of);
        push(of, held, Vec3::Unit(axis));
        turn_by_moments(of);
        mobility += way(of, held)[axis];
    }
    const double z = (held.k * h * h + held.c * h) * mobility / 3, s = z / (4 + z) * (z / (4 + z));
    of.forces[k].kappa = held.k * (1 + s) / 2 + held.c / h;
    of.forces[k].g = s * (h * h * held.k + h * held.c) / 2;
}

// Is F of each what its force asks for? Where it is not, it is made larger.
template <class T> bool bounded(HeldPoints<T>& of) {
    clear_moments(of);
    for (std::size_t k = 0; k < of.all.size(); ++k)
        if (of.all[k].on) push(of, of.all[k], part(of.solved, k) - of.forces[k].before);
    turn_by_moments(of);
    bool all = true;
    for (std::size_t k = 0; k < of.all.size(); ++k) {
        if (!of.all[k].on) continue;
        double most = 0;
        along(of, of.all[k],
              [&](const HeldJoint<T>& j, double, const Vec3&, const Vec3&) { most = std::max(most, j.turn.norm()); });
        const double strain = std::min(1.0, most / far_turn), asked = strain * strain * part(of.solved, k).norm();
        if (!(asked > of.forces[k].most)) continue;
        of.forces[k].most = std::max(4 * of.forces[k].most, asked);
        all = false;
    }
    return all;
}

template <class T> void find_joints(const Plan<T>& plan, HeldPoints<T>& of) {
    std::vector<std::size_t> touched;
    find_path_joints(
        plan, [&](const auto& visit) { each_end(of.all, visit); }, touched, of.joints);
    for (HeldJoint<T>& j : of.joints) j.depth = j.parent < 0 ? 1 : of.joints[std::size_t(j.parent)].depth + 1;
    of.forces.assign(of.all.size(), {});
    const auto size = 3 * Eigen::Index(of.all.size());
    of.answers.setZero(size, size);
    of.asked.setZero(size);
    of.solved.setZero(size);
    if (size > 0) of.factors.emplace(Eigen::MatrixXd::Identity(size, size));
}

} // namespace

template <class T> HeldPoints<T> planned_held(const Plan<T>& plan) {
    HeldPoints<T> of;
    of.all = planned_attachments(plan);
    find_joints(plan, of);
    place_points(plan, plan.theta_start, 0, of);
    for (Attached& held : of.all)
        held.target = target_at_start(plan, held, held.start, held.far ? held.far->start : Vec3(Vec3::Zero()));
    return of;
}

template <class T>
void release_held(const Plan<T>& plan, AnalyticWork<T>& work, const std::vector<std::size_t>& bodies) {
    if (!work.held.any()) return;
    const auto gone = [&](std::size_t body) { return std::find(bodies.begin(), bodies.end(), body) != bodies.end(); };
    for (const HeldJoint<T>& j : work.held.joints) {
        work.held_tau_w[j.body].setZero();
        work.held_row[j.body] = 0;
    }
    std::erase_if(work.held.all,
                  [&](const Attached& held) { return gone(held.body) || (held.far && gone(held.far->body)); });
    find_joints(plan, work.held);
}

template <class T>
void hold_points(const Plan<T>& plan, const AnalyticPlan<T>& own, const State<T>& s, AnalyticWork<T>& work,
                 double time) {
    HeldPoints<T>& of = work.held;
    const double h = plan.dt;
    place_points(plan, s.theta, time, of);
    for (HeldJoint<T>& j : of.joints) {
        work.held_tau_w[j.body].setZero();
        work.held_row[j.body] = 0;
        j.load = spring_joint(plan, own, s, work, j.body);
    }
    for (std::size_t k = 0; k < of.all.size(); ++k) {
        Attached& held = of.all[k];
        held.on = holds(held, time + h / 2);
        held.k = held.stiffness;
        held.c = held.damping;
        lead(plan, held, time);
        of.forces[k].before = held.force;
        of.forces[k].most = held.force.norm();
    }
    answer(plan, own, s, work, of);
    answer_to_impulses(of);
    for (std::size_t k = 0; k < of.all.size(); ++k) weigh(plan, of, k);
    do {
        answer(plan, own, s, work, of);
        for (std::size_t k = 0; k < of.all.size(); ++k) {
            const Attached& held = of.all[k];
            auto asked = of.asked.template segment<3>(3 * Eigen::Index(k));
            asked.setZero();
            if (!held.on) continue;
            const Vec3 far = held.far ? held.far->start : Vec3(Vec3::Zero());
            asked = -held.k / std::max(of.forces[k].kappa, least) * (held.start - far - held.from_target) -
                    (way(of, held) - (held.to_target - held.from_target));
        }
        solve(of, [](const HeldForce& f) { return f.kappa; });
    } while (!bounded(of));
    clear_moments(of);
    for (std::size_t k = 0; k < of.all.size(); ++k) {
        Attached& held = of.all[k];
        held.force = held.spring = held.on ? part(of.solved, k) : Vec3(Vec3::Zero());
        if (held.on) push(of, held, held.force);
    }
    for (const HeldJoint<T>& j : of.joints) {
        work.held_tau_w[j.body] = j.moment.template cast<T>();
        work.held_row[j.body] = T(j.row);
    }
}

template <class T> void slow_held(const Plan<T>& plan, State<T>& s, AnalyticWork<T>& work) {
    HeldPoints<T>& of = work.held;
    place_points(plan, s.theta, time_of(plan, s, 1), of);
    for (HeldJoint<T>& j : of.joints)
        j.turn = j.R * (body_rate_jacobian(s.theta[j.body]) * s.theta_dot[j.body]).template cast<double>();
    for (std::size_t k = 0; k < of.all.size(); ++k) {
        const Attached& held = of.all[k];
        auto asked = of.asked.template segment<3>(3 * Eigen::Index(k));
        asked.setZero();
        if (held.on) asked = held.target_velocity + held.quicker / 2 - way(of, held);
    }
    answer_to_impulses(of);
    solve(of, [](const HeldForce& f) { return f.g; });
    clear_moments(of);
    for (std::size_t k = 0; k < of.all.size(); ++k)
        if (of.all[k].on) push(of, of.all[k], part(of.solved, k));
    for (const HeldJoint<T>& j : of.joints) {
        const Mat3 L = j.L.template cast<double>();
        const Vec3 gained = L.triangularView<Eigen::Lower>().solve(Vec3(j.R.transpose() * j.moment));
        Vector3<T>& rate = work.scaled_rate[j.body];
        rate += gained.cast<T>();
        Vector3<T> omega_b = rate;
        j.L.transpose().template triangularView<Eigen::Upper>().solveInPlace(omega_b);
        s.theta_dot[j.body] = body_rate_jacobian_inverse(s.theta[j.body]) * omega_b;
    }
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template HeldPoints<T> planned_held(const Plan<T>&);                                                               \
    template void release_held(const Plan<T>&, AnalyticWork<T>&, const std::vector<std::size_t>&);                     \
    template void hold_points(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, AnalyticWork<T>&, double);      \
    template void slow_held(const Plan<T>&, State<T>&, AnalyticWork<T>&);
#include "../base/instantiate.inc"

} // namespace bough
