#include "attachment_ties.h"
#include "articulated_algebra.h"
#include "midpoint.h"

namespace bough {
namespace {

using Complex = std::complex<double>;

struct TieSolve {
    Attachments& a;
    Complex z1, z2; // 1/s, 1/s^2

    bool on(const Tie& tie) const { return tie.follows ? a.pulled[tie.of].on : a.all[tie.of].on; }
    Complex sigma(const Attached& held) const { return std::sqrt(z2 * held.k + z1 * held.c); }

    void clear() {
        for (SolvedBody& q : a.solved) {
            q.N.setZero();
            q.F.setZero();
        }
    }

    // What a tie's unknown does.
    void push(const Tie& tie, const ComplexVec3& y) {
        const auto add = [&](std::size_t at, const ComplexVec3& N, const ComplexVec3& F) {
            a.solved[at].N += N;
            a.solved[at].F += F;
        };
        if (tie.follows) {
            const PulledPoint& f = a.pulled[tie.of];
            return add(f.at, z2 / 2.0 * cross(f.moment, y), z2 * cross(f.force, y));
        }
        const Attached& held = a.all[tie.of];
        const ComplexVec3 F = sigma(held) * y;
        add(held.at, cross(held.rho, F), F);
        add(held.far->at, -cross(held.far->rho, F), -F);
    }

    // Of what was pushed.
    void inward() {
        for (std::size_t i = a.bodies.size(); i-- > 0;) {
            const AttachedBody& b = a.bodies[i];
            SolvedBody& q = a.solved[i];
            q.moment = q.N;
            q.gain = -(q.E * q.N);
            if (b.parent < 0) continue;
            SolvedBody& p = a.solved[std::size_t(b.parent)];
            const ComplexVec3 f = q.F - q.EB.transpose() * q.N;
            p.F += f;
            p.N += q.N - q.EA.transpose() * q.N + cross(b.r, f);
        }
    }

    // base(body, alpha, a): the ground's own. eu(body): its E u.
    template <class Base, class Eu> void outward(Base&& base, Eu&& eu) {
        for (std::size_t i = 0; i < a.bodies.size(); ++i) {
            const AttachedBody& b = a.bodies[i];
            SolvedBody& q = a.solved[i];
            ComplexVec3 alpha = ComplexVec3::Zero(), start = ComplexVec3::Zero();
            if (b.parent < 0) {
                base(b, alpha, start);
            } else {
                alpha = a.solved[std::size_t(b.parent)].alpha;
                start = a.solved[std::size_t(b.parent)].a;
            }
            q.a = start - cross(b.r, alpha);
            q.alpha = alpha + eu(q) - q.EA * alpha - q.EB * q.a;
        }
    }

    // What the unknown is by the accelerations, but for F_0.
    ComplexVec3 answer(const Tie& tie) const {
        if (tie.follows) return a.solved[a.pulled[tie.of].at].alpha;
        const Attached& held = a.all[tie.of];
        const auto at = [&](const AttachedEnd& end) {
            const SolvedBody& q = a.solved[end.at];
            return ComplexVec3(q.a - cross(end.rho, q.alpha));
        };
        return sigma(held) * (at(held) - at(*held.far));
    }
};

} // namespace

void find_ties(Attachments& a) {
    a.ties.clear();
    for (std::size_t k = 0; k < a.all.size(); ++k)
        if (a.all[k].far) a.ties.push_back({false, k});
    for (std::size_t k = 0; k < a.pulled.size(); ++k)
        if (a.pulled[k].turns) a.ties.push_back({true, k});
    a.solved.resize(a.ties.empty() ? 0 : a.bodies.size());
    const auto size = 3 * Eigen::Index(a.ties.size());
    a.answers.resize(size, size);
    a.asked.resize(size);
    a.unknowns.resize(size);
    if (size > 0) a.factors = Eigen::PartialPivLU<Eigen::MatrixXcd>(size);
}

template <class T> void solve_ties(const Plan<T>& plan, CoupledState<T>& work, std::complex<double> p) {
    Attachments& a = work.attachments;
    const Complex z1 = plan.dt / p, z2 = z1 * z1, z_slope = 1.0 / p - 0.5;
    const auto of_ground = [&](const GroundStep<T>& g) {
        return ComplexVec3(g.alpha.template cast<Complex>() + z_slope * g.slope_alpha.template cast<Complex>());
    };
    const auto ground = [&](const AttachedBody& b, ComplexVec3& alpha, ComplexVec3& start) {
        const GroundStep<T>* g = ground_step_of(plan, work, b.body);
        if (!g) return;
        alpha = of_ground(*g);
        start = g->a.template cast<Complex>() + z_slope * g->slope_a.template cast<Complex>();
    };
    const auto at_rest = [](const AttachedBody&, ComplexVec3&, ComplexVec3&) {};

    TieSolve solve{a, z1, z2};
    solve.outward(ground, [](const SolvedBody& q) { return q.Eu; });
    for (std::size_t j = 0; j < a.ties.size(); ++j) {
        const Tie& tie = a.ties[j];
        auto asked = a.asked.segment<3>(3 * Eigen::Index(j));
        asked.setZero();
        if (!solve.on(tie)) continue;
        asked = solve.answer(tie);
        if (tie.follows) { // as it turns by the joints alone, like H
            if (const GroundStep<T>* g = ground_step_of(plan, work, a.pulled[tie.of].body)) asked -= of_ground(*g);
            continue;
        }
        ComplexVec3 F = tie.F.cast<Complex>() + z_slope * tie.slope.cast<Complex>() + z1 * tie.rate.cast<Complex>();
        const Complex weights[4] = {z2, z1, z2 * z_slope, z1 * z_slope};
        for (int part = 0; part < 4; ++part) F += weights[part] * tie.ground.col(part).cast<Complex>();
        asked += F / solve.sigma(a.all[tie.of]);
    }
    a.answers.setIdentity();
    for (std::size_t m = 0; m < a.ties.size(); ++m) {
        if (!solve.on(a.ties[m])) continue;
        for (int axis = 0; axis < 3; ++axis) {
            solve.clear();
            solve.push(a.ties[m], ComplexVec3::Unit(axis));
            solve.inward();
            solve.outward(at_rest, [](const SolvedBody& q) { return q.gain; });
            for (std::size_t j = 0; j < a.ties.size(); ++j)
                if (solve.on(a.ties[j]))
                    a.answers.block<3, 1>(3 * Eigen::Index(j), 3 * Eigen::Index(m) + axis) -= solve.answer(a.ties[j]);
        }
    }
    a.factors.compute(a.answers);
    a.unknowns = a.factors.solve(a.asked);

    solve.clear();
    for (std::size_t j = 0; j < a.ties.size(); ++j)
        if (solve.on(a.ties[j])) solve.push(a.ties[j], a.unknowns.segment<3>(3 * Eigen::Index(j)));
    solve.inward();
}

#define BOUGH_INSTANTIATE(T) template void solve_ties(const Plan<T>&, CoupledState<T>&, std::complex<double>);
#include "../base/instantiate.inc"

} // namespace bough
