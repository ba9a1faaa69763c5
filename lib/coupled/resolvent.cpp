#include "resolvent.h"
#include "../base/parallel.h"
#include "../laws/air_load.h"
#include "articulated_algebra.h"
#include "attachment.h"
#include "attachment_plain.h"
#include "midpoint.h"

namespace bough {
namespace {

template <class T, class S> struct Solve {
    const Plan<T>& plan;
    const State<T>& state;
    CoupledWork<T>& work;
    std::vector<ResolventBody<S>>& body;
    S p, c, s1, s2, slope; // s1 = 1/s, s2 = 1/s^2
    std::complex<double> pole;
    T h;

    Solve(const Plan<T>& pl, const State<T>& st, CoupledWork<T>& wk, std::vector<ResolventBody<S>>& bodies,
          const Pole& of)
        : plan(pl), state(st), work(wk), body(bodies), p(field<S>(of.p, T())), c(field<S>(of.c, T())),
          s1(field<S>(pl.dt / of.p, T())), s2(field<S>(pl.dt / of.p * pl.dt / of.p, T())),
          slope(field<S>(1.0 / of.p - 0.5, T())), pole(of.p), h(T(pl.dt)) {}

    void start(std::size_t i) {
        const CoupledBody<T>& b = work.coupled[i];
        ResolventBody<S>& q = body[i];
        const T m = plan.mass[i];
        q.A = b.J.template cast<S>() + s2 * b.H.template cast<S>();
        q.B = (m * cross_matrix(b.c)).template cast<S>();
        q.M = (m * Matrix3<T>::Identity()).template cast<S>();
        // By the joints alone: what the ground turns it turns with the springs, and a tree at rest on it stays so.
        Vector3<T> own = b.omega_0;
        if (const GroundStep<T>* g = ground_step_of(plan, work, i)) own -= g->omega_0;
        q.N = b.N.template cast<S>() + s1 * (b.H * own).template cast<S>();
        q.F = b.F.template cast<S>();
        if (plan.wind) {
            const Matrix3<T> cD = cross_left(b.c, b.D);
            const Matrix3<T> cDc = cross_left(b.c, Matrix3<T>(cD.transpose()));
            q.A += s1 * cDc.template cast<S>();
            q.B += s1 * cD.template cast<S>();
            q.M += s1 * b.D.template cast<S>();
            if (b.spin > 0) damp_spin(q, b, m);
        }
        if (plan.forces) {
            q.N += slope * b.slope_N.template cast<S>();
            q.F += slope * b.slope_F.template cast<S>();
        }
    }

    [[gnu::noinline]] void damp_spin(ResolventBody<S>& q, const CoupledBody<T>& b, T m) {
        q.A += (s1 * b.spin) * central_inertia(m, b.J, b.c).template cast<S>();
    }

    void attach(const AttachedBody& b) {
        const AttachmentTerms<S> more = attachment_terms<S>(b.sums, pole, plan.dt);
        ResolventBody<S>& q = body[b.body];
        q.A += more.A;
        q.B += more.B;
        q.M += more.M;
        q.N += more.N;
        q.F += more.F;
    }

    void eliminate(std::size_t i) {
        const CoupledBody<T>& b = work.coupled[i];
        ResolventBody<S>& q = body[i];
        const Matrix3<T> stiffness = b.rates.transpose() * plan.K[i].asDiagonal() * b.rates;
        const S z = plan.beta[i] * s1 + s2;
        q.E = symmetric_inverse(Matrix<S>(q.A + z * stiffness.template cast<S>()));
        q.u = b.torque.template cast<S>() - s1 * b.torque_rate.template cast<S>() - q.N;
        if (plan.parent[i] < 0) return;
        hand_on(q, z, stiffness, b.r, body[std::size_t(plan.parent[i])]);
    }

    void accelerate(std::size_t i, const Vector<S>& alpha_p, const Vector<S>& a_p) {
        const CoupledBody<T>& b = work.coupled[i];
        ResolventBody<S>& q = body[i];
        const Vector<S> gamma = accelerate_joint(q, b.r, alpha_p, a_p);
        const Vector<S> x = b.rates.template cast<S>() * gamma;
        const Vector<S> x_v = quotient(Vector<S>(-x), p),
                        x_u = quotient(Vector<S>(h * x_v - state.theta_dot[i].template cast<S>()), p);
        work.theta_dot_change[i] += h * weighed(Vector<S>(c * x_v));
        work.theta_change[i] += h * weighed(Vector<S>(c * x_u));
    }

    static Vector3<T> weighed(const Vector<S>& z) {
        if constexpr (is_complex<T, S>)
            return T(2) * z.real();
        else
            return z;
    }

    // The moving ground's acceleration at the joint's place, and its angular one.
    void accelerate_root(std::size_t i) {
        Vector<S> alpha = Vector<S>::Zero(), a = Vector<S>::Zero();
        if (const GroundStep<T>* g = ground_step_of(plan, work, i)) {
            a = g->a.template cast<S>() + slope * g->slope_a.template cast<S>();
            alpha = g->alpha.template cast<S>() + slope * g->slope_alpha.template cast<S>();
        }
        accelerate(i, alpha, a);
    }

    void run() {
        parallel_for(plan.bodies, 50, [this](std::size_t i) { start(i); });
        for (const AttachedBody& b : work.attachments.bodies) attach(b);
        for (std::size_t i = plan.bodies; i-- > 0;) eliminate(i);
        if (!work.attachments.ties.empty()) tie_bodies(plan, work, body, pole);
        for (std::size_t i = 0; i < plan.bodies; ++i)
            if (plan.parent[i] < 0)
                accelerate_root(i);
            else
                accelerate(i, body[std::size_t(plan.parent[i])].alpha, body[std::size_t(plan.parent[i])].a);
    }
};

} // namespace

template <class T>
void resolvent(const Plan<T>& plan, const CoupledPlan<T>& own, State<T>& state, CoupledWork<T>& work,
               const Pole& pole) {
    if (scheme_of(own.scheme).real)
        Solve<T, T>(plan, state, work, work.resolvent_real, pole).run();
    else
        Solve<T, std::complex<T>>(plan, state, work, work.resolvent, pole).run();
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void resolvent(const Plan<T>&, const CoupledPlan<T>&, State<T>&, CoupledWork<T>&, const Pole&);
#include "../base/instantiate.inc"

} // namespace bough
