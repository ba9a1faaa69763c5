#include "pulled_points.h"
#include "../plan/pushes.h"
#include "attachment_paths.h"
#include <algorithm>

namespace bough {
namespace {

// H of what carries a force f at the place P from its joint.
void turn_with(AttachedBody& b, const Vec3& P, const Vec3& f, double w) {
    const Mat3 Pf = P * f.transpose();
    const Mat3 H = (1 - w) * (P.dot(f) * Mat3::Identity() - (Pf + Pf.transpose()) / 2) + w * direction_bound(P, f, 0);
    b.sums.A_stiffness += H;
    b.sums.N -= H * b.turn;
    b.sums.N_rate += H * b.own;
}

} // namespace

template <class T> bool take_loads(const Plan<T>& plan, const State<T>& state, Attachments& a) {
    if (!plan.loads || plan.contact || !plan.scene.walkers.empty()) return false;
    const std::size_t first = std::size_t(
        std::find_if(a.pulled.begin(), a.pulled.end(), [](const PulledPoint& p) { return p.source == of_caller; }) -
        a.pulled.begin());
    const auto of = [](const Load<T>& load) {
        PulledPoint point{};
        point.body = load.body;
        point.point_b = load.point_b.template cast<double>();
        point.source = of_caller;
        point.force = load.force.template cast<double>();
        return point;
    };
    bool same = a.pulled.size() == first + state.loads.size();
    for (std::size_t k = 0; same && k < state.loads.size(); ++k) same = a.pulled[first + k].body == state.loads[k].body;
    if (same) {
        for (std::size_t k = 0; k < state.loads.size(); ++k) {
            const std::size_t at = a.pulled[first + k].at;
            a.pulled[first + k] = of(state.loads[k]);
            a.pulled[first + k].at = at;
        }
        return false;
    }
    a.pulled.resize(first);
    for (const Load<T>& load : state.loads) a.pulled.push_back(of(load));
    find_bodies(plan, a);
    return true;
}

template <class T> void place_pull(const Plan<T>& plan, Attachments& a, PulledPoint& point, double time) {
    if (point.source == of_caller) return;
    const Pull& pull = plan.scene.pulls[point.source];
    const double h = plan.dt;
    AttachedBody& b = a.bodies[point.at];
    const Mat3 axes = point.turns ? b.R : Mat3::Identity();
    const Vec3 change = axes * (pull_force(pull, time + h) - pull_force(pull, time));
    point.force = axes * pull_force(pull, time + h / 2);
    point.moment = point.rho.cross(point.force);
    point.on = !point.force.isZero(0) || !change.isZero(0);
    if (!point.on || !point.turns) return;
    const auto load = [&](const Vec3& f, const Vec3& m, Vec3& F, Vec3& N) {
        F -= f;
        N -= m;
    };
    const auto turned = [&](const Vec3& psi, Vec3& F, Vec3& N) { // by psi
        load(psi.cross(point.force), psi.cross(point.moment) / 2, F, N);
    };
    load(point.force, point.moment, b.sums.F, b.sums.N);
    turned(-b.turn, b.sums.F, b.sums.N);
    turned(b.own, b.sums.F_rate, b.sums.N_rate);
    load(change, point.rho.cross(change), b.sums.F_slope, b.sums.N_slope);
}

template <class T> void add_directions(const Plan<T>& plan, Attachments& a) {
    bool any = false;
    for (const PulledPoint& point : a.pulled) any = any || !point.force.isZero(0);
    if (!any) return;
    for (AttachedBody& b : a.bodies) {
        b.pulled.setZero();
        b.share = 0;
        b.give = 1 / answering_stiffness(plan, b);
        if (b.parent >= 0) b.give += a.bodies[std::size_t(b.parent)].give;
    }
    for (const PulledPoint& point : a.pulled) {
        AttachedBody& b = a.bodies[point.at];
        b.pulled += point.force;
        if (!point.turns) b.share += point.rho.norm() * point.force.norm() * b.give;
    }
    for (std::size_t k = a.bodies.size(); k-- > 0;) {
        AttachedBody& b = a.bodies[k];
        if (b.parent < 0) continue;
        AttachedBody& p = a.bodies[std::size_t(b.parent)];
        p.pulled += b.pulled;
        p.share += b.share + b.r.norm() * b.pulled.norm() * p.give;
    }
    for (AttachedBody& b : a.bodies) {
        if (b.parent < 0) continue;
        AttachedBody& p = a.bodies[std::size_t(b.parent)];
        b.share = p.share; // the tree's
        turn_with(p, b.r, b.pulled, std::min(1.0, p.share * p.share));
    }
    for (const PulledPoint& point : a.pulled) {
        AttachedBody& b = a.bodies[point.at];
        if (!point.turns) turn_with(b, point.rho, point.force, std::min(1.0, b.share * b.share));
    }
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template bool take_loads(const Plan<T>&, const State<T>&, Attachments&);                                           \
    template void place_pull(const Plan<T>&, Attachments&, PulledPoint&, double);                                      \
    template void add_directions(const Plan<T>&, Attachments&);
#include "../base/instantiate.inc"

} // namespace bough
