// analytic_joints.h: what the joints' own steps (wide_spring.h) read and write in the rows, and the cases that are treated one by one: half turns,
// and turns so large that their energy is checked (analytic/spring.h). That check is written a second time, beside energy_gained of spring_joint.cpp,
// because it takes what the joint's step left in registers, for all lanes at once; only those that turned so far heed it.
#pragma once
#include "../base/oscillator.h"
#include "../laws/turn_guard.h"
#include "analytic_chains.h"
#include "wide_spring.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace analytic_step {

// Where a lane stands.
struct LaneOfRow {
    std::uint32_t row;
    int lane;
};

// The same part of one row, or of two, as one number.
template <class X, class Real = RealOf<X>> struct Across {
    using T = RealOf<X>;
    Real* at[Registers<X>::count];

    BOUGH_FORCE X real(int k) const {
        X x;
        for (int j = 0; j < Registers<X>::count; ++j) Registers<X>::part(x, j) = read<T>(at[j] + k * lanes<T>);
        return x;
    }
    BOUGH_FORCE V3<X> vector(int k) const { return {real(k), real(k + 1), real(k + 2)}; }
    BOUGH_FORCE Symmetric<X> symmetric(int k) const {
        return {real(k), real(k + 1), real(k + 2), real(k + 3), real(k + 4), real(k + 5)};
    }
    BOUGH_FORCE void set(int k, const X& x) const {
        for (int j = 0; j < Registers<X>::count; ++j) write<T>(at[j] + k * lanes<T>, Registers<X>::part(x, j));
    }
    BOUGH_FORCE void set(int k, const V3<X>& v) const {
        set(k, v.x);
        set(k + 1, v.y);
        set(k + 2, v.z);
    }
};

template <class T, bool wind, bool pulls, bool gravity, bool field, class Own>
struct AnalyticJoints : AnalyticChains<T, wind, pulls, gravity, field, Own> {
    using Base = AnalyticChains<T, wind, pulls, gravity, field, Own>;
    using Base::about_half_turn2;
    using Base::Base;
    using Base::flags;
    using Base::forces;
    using Base::L;
    using Base::rows;
    using Base::still_finite2;
    using typename Base::W;

    W size{}; // sum of what would not be finite

    [[gnu::noinline]] static void count(const W& value, T above, const W& mass, std::uint64_t& number) {
        for (int l = 0; l < width<T>; ++l)
            if (value[l] > above && mass[l] > 0) ++number;
    }

    // Half turns.
    [[gnu::noinline]] V3<W> shorter(const V3<W>& theta, const W& mass) {
        V3<W> out = theta;
        for (int l = 0; l < width<T>; ++l) {
            T t[3] = {theta.x[l], theta.y[l], theta.z[l]};
            if (!rows.shorten(t)) continue;
            if (mass[l] > 0) ++flags.half_turns;
            out.x[l] = t[0], out.y[l] = t[1], out.z[l] = t[2];
        }
        return out;
    }

    // Returns what the rates keep where a large turn has gained energy (spring.h).
    template <class X>
    [[gnu::noinline]] X kept(const JointLoad<X>& in, const JointStep<X>& step, const V3<X>& theta,
                             const X* mass_given) {
        using P = Registers<X>;
        const X after = dot(step.rate, step.rate), before = dot(step.rate_before, step.rate_before);
        const V3<X> sum = step.theta + in.theta, change = step.theta - in.theta;
        const X elastic = T(0.5) * (change.x * in.K.x * sum.x + change.y * in.K.y * sum.y + change.z * in.K.z * sum.z);
        X excess = T(0.5) * (after - before) + elastic;
        if constexpr (gravity) {
            const auto turned_by = [](const V3<X>& t, const V3<X>& v) {
                const X q = dot(t, t);
                const Turn<X> turn = turn_of(q);
                const V3<X> across = cross(t, v);
                return v + turn.s * across + turn.c1 * cross(t, across);
            };
            const V3<X> h = turned_by(-in.theta, turned_by(theta, in.h));
            excess = excess - dot(in.g, h - in.h);
        }
        if constexpr (forces) excess = excess - dot(in.tau, step.phi);
        X keep = each<X>(1);
        const X turn2 = dot(step.phi, step.phi);
        const X& mass = *mass_given;
        for (int j = 0; j < P::count; ++j)
            for (int l = 0; l < width<T>; ++l) {
                const T gained = P::part(excess, j)[l];
                if (!(P::part(turn2, j)[l] > guarded2) || !(gained > 0)) continue;
                const T rest = 1 - 2 * gained / P::part(after, j)[l];
                P::part(keep, j)[l] = std::sqrt(rest > 0 ? rest : T(0));
                if (P::part(mass, j)[l] > 0) ++flags.energy_guard;
            }
        return keep;
    }
    static constexpr T guarded2 = T(guarded_turn) * T(guarded_turn);

    // Where a joint's quantities stand, for one register or two.
    template <class X> struct At {
        Across<X, const T> constants;
        Across<X> motion;
        Across<X, const T> loaded;
    };
    template <class X> BOUGH_FORCE At<X> at(const LaneOfRow* places) const {
        At<X> a;
        for (int j = 0; j < Registers<X>::count; ++j) {
            a.constants.at[j] = this->constants_at(places[j].row, places[j].lane);
            a.motion.at[j] = this->motion_at(places[j].row, places[j].lane);
            a.loaded.at[j] = this->loaded_at(places[j].row, places[j].lane);
        }
        return a;
    }

    // Loads all that a step and the check of its energy read, and nothing that only the joint's solve is made of (J, beta, factors).
    template <class X> BOUGH_FORCE JointLoad<X> load(const At<X>& a) const {
        JointLoad<X> in;
        if constexpr (gravity) {
            in.h = a.loaded.vector(loaded::h);
            in.g = a.loaded.vector(loaded::g);
        }
        if constexpr (forces) in.tau = a.loaded.vector(loaded::tau);
        if constexpr (wind) {
            in.drag_tau = a.loaded.vector(loaded::drag_f);
            in.drag_row = a.loaded.real(loaded::drag);
            in.inverse_weight = a.constants.real(constant::inverse_weight);
        }
        in.theta = a.motion.vector(motion::theta);
        in.rate = a.motion.vector(motion::scaled_rate);
        in.K = a.constants.vector(constant::K);
        return in;
    }

    // Ends a step: corrects large turns, and writes the motion.
    template <class X> BOUGH_FORCE void finish(const At<X>& a, const JointLoad<X>& in, JointStep<X>& step) {
        using P = Registers<X>;
        V3<X> theta = step.theta;
        X q = dot(theta, theta);
        if (any_above(q, each<X>(about_half_turn2))) {
            for (int j = 0; j < P::count; ++j) {
                const V3<W> t{P::part(theta.x, j), P::part(theta.y, j), P::part(theta.z, j)};
                const V3<W> s = shorter(t, read<T>(a.constants.at[j] + constant::mass * L));
                P::part(theta.x, j) = s.x, P::part(theta.y, j) = s.y, P::part(theta.z, j) = s.z;
            }
            q = dot(theta, theta);
        }
        if (any_above(dot(step.phi, step.phi), each<X>(guarded2))) {
            const X mass = a.constants.real(constant::mass), keep = kept(in, step, theta, &mass);
            step.rate = keep * step.rate;
            step.omega = keep * step.omega;
        }
        a.motion.set(motion::theta, theta);
        a.motion.set(motion::scaled_rate, step.rate);
        const V3<X> rate = rate_of(theta, t2_of(q), step.omega);
        a.motion.set(motion::theta_dot, rate);
        const X all_of_it = q + dot(rate, rate);
        for (int j = 0; j < P::count; ++j) size = size + P::part(all_of_it, j);
    }
    // ---- a step worked out in full

    LaneOfRow waiting[2]; // joints whose composites are there
    int waiters = 0;

    BOUGH_FORCE void step_next(std::uint32_t row, int lane) {
        waiting[waiters++] = {row, lane};
        if (waiters < 2) return;
        step_full<Pair<W>>(); // while both are at hand; each waits for its own eigenvalues
        waiters = 0;
    }
    void step_last() {
        if (waiters > 0) step_full<W>();
        waiters = 0;
    }

    // Returns the joint's rate as the last step left it.
    BOUGH_FORCE V3<W> kept_rate(std::uint32_t row, int lane, const V3<W>& theta, const Turn<W>& turn) const {
        const V3<W> eta = Rows<const T>{this->motion_at(row, lane)}.vector(motion::theta_dot),
                    across = cross(theta, eta);
        return eta - turn.c1 * across + turn.c2 * cross(theta, across);
    }

    template <class X> [[gnu::noinline]] void step_full() {
        const auto a = at<X>(waiting);
        JointLoad<X> in = load(a);
        in.J = a.loaded.symmetric(loaded::J);
        if constexpr (gravity) in.gravity_row = a.constants.real(constant::gravity_row);
        if constexpr (wind) {
            in.wind_row = a.loaded.real(loaded::wind);
            in.turn_row = a.loaded.real(loaded::turn);
        }
        in.beta = a.constants.real(constant::beta);
        in.bend = a.constants.real(constant::bend);
        in.twist = a.constants.real(constant::twist);
        JointLambdas<X> o;
        JointStep<X> step = step_joint<wind, gravity, forces>(in, rows.h, largest_lambda<T>(), o);

        const X softest = -larger(larger(-o.lambda[0], -o.lambda[1]), -o.lambda[2]);
        if (any_above(X{}, softest) || o.bounded)
            for (int m = 0; m < 3; ++m)
                for (int j = 0; j < Registers<X>::count; ++j) {
                    const W mass = read<T>(a.constants.at[j] + constant::mass * L);
                    count(-Registers<X>::part(o.lambda[m], j), 0, mass, flags.buckling);
                    count(Registers<X>::part(o.with_air[m], j), largest_lambda<T>(), mass, flags.bounded_lambda);
                }
        finish(a, in, step);
    }

    void see_finite() const {
        if (!(total(size) < still_finite2)) flags.finite = false;
    }
};

} // namespace analytic_step
} // namespace BOUGH_TARGET
} // namespace bough::fast
