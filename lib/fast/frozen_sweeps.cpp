// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "../stages/frozen_rule.h"
#include "analytic_joints.h"
#include "wide_frozen.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

using namespace analytic_step;
namespace kept = analytic::frozen;

template <class T, bool wind, bool pulls, bool gravity, bool field>
struct FrozenSweep : AnalyticJoints<T, wind, pulls, gravity, field, FrozenSweep<T, wind, pulls, gravity, field>> {
    using Base = AnalyticJoints<T, wind, pulls, gravity, field, FrozenSweep>;
    using Base::Base;
    using Base::flags;
    using Base::forces;
    using Base::L;
    using Base::rows;
    using typename Base::W;

    // Leaves and fruit in wind are worked out in full: it would make them anew every few frames.
    template <Kind kind> static constexpr bool frozen = kind == Kind::branch;

    static constexpr int most_waiting = 16;
    Place ready[most_waiting]; // joints whose composites are there
    int readies = 0;
    struct Stale {
        std::uint32_t row;
        int lane;
        T J[6];
    };
    Stale stale[most_waiting * width<T>]; // and of them, those whose coefficients no longer hold
    int stales = 0;

    T* frozen_at(std::uint32_t row, int lane) const { return rows.frozen + row * std::size_t(kept::count) * L + lane; }

    template <Kind kind>
    BOUGH_FORCE V3<W> joint_rate(std::uint32_t row, int lane, const V3<W>& theta, const Turn<W>& turn) const {
        if constexpr (!frozen<kind>) return this->kept_rate(row, lane, theta, turn);
        return Rows<const T>{frozen_at(row, lane)}.matrix(kept::U) *
               Rows<const T>{this->motion_at(row, lane)}.vector(motion::scaled_rate);
    }

    BOUGH_FORCE void joint_loaded(Kind kind, std::uint32_t row, int lane, const Seen<W>& seen) {
        if (kind != Kind::branch) {
            this->step_next(row, lane);
            return;
        }
        const Rows<const T> old{frozen_at(row, lane)};
        const Symmetric<W> J = old.symmetric(kept::J), change = seen.J - J;
        const W turned = larger(larger(larger(magnitude(change.xx), magnitude(change.xy)),
                                       larger(magnitude(change.xz), magnitude(change.yy))),
                                larger(magnitude(change.yz), magnitude(change.zz))),
                most_turned = T(0.5) * rows.tolerance * (J.xx + J.yy + J.zz);
        W loaded{};
        if constexpr (gravity) loaded = magnitude(seen.gravity - old.real(kept::gravity));
        if constexpr (wind) loaded = larger(loaded, magnitude(seen.wind - old.real(kept::wind)));
        loaded = old.real(kept::sensitivity) * loaded;
        const W most_loaded = all(T(frozen_load_share) * rows.tolerance);
        if (any_above(turned, most_turned) || any_above(loaded, most_loaded))
            note(row, lane, seen.J, turned, most_turned, loaded, most_loaded);
        ready[readies++] = {row, lane};
        if (readies == most_waiting) step_ready();
    }

    [[gnu::noinline]] void note(std::uint32_t row, int lane, const Symmetric<W>& J, const W& turned,
                                const W& most_turned, const W& loaded, const W& most_loaded) {
        for (int l = 0; l < width<T>; ++l)
            if (turned[l] > most_turned[l] || loaded[l] > most_loaded[l])
                stale[stales++] = {row, lane + l, {J.xx[l], J.xy[l], J.xz[l], J.yy[l], J.yz[l], J.zz[l]}};
    }

    // Stale joints side by side, as many as a register holds, whichever rows they stand in.
    struct Gathered {
        enum : int {
            J = 0,
            J_parent = 6,
            h = 12,
            g = 15,
            air = 18,
            turn = 19,
            theta = 20,
            rate = 23,
            K = 26,
            beta = 29,
            bend = 30,
            twist = 31,
            gravity_row = 32,
            inverse_weight = 33,
            mass = 34,
            U = 35,
            count = 44
        };
        alignas(64) T at[count * L];
        void put(int lane, int quantity, const T* from, int reals) {
            for (int k = 0; k < reals; ++k) at[(quantity + k) * L + lane] = from[k * L];
        }
    };

    [[gnu::noinline]] void refresh(const Stale* first, int number) {
        Gathered gathered;
        using G = Gathered;
        for (int l = 0; l < width<T>; ++l) { // what is over repeats the first one
            const Stale& one = first[l < number ? l : 0];
            const T *k = this->constants_at(one.row, one.lane), *y = this->motion_at(one.row, one.lane),
                    *x = this->loaded_at(one.row, one.lane);
            for (int j = 0; j < 6; ++j) gathered.at[(G::J_parent + j) * L + l] = one.J[j];
            gathered.put(l, G::J, x + loaded::J * L, 6);
            if constexpr (gravity) {
                gathered.put(l, G::h, x + loaded::h * L, 3);
                gathered.put(l, G::g, x + loaded::g * L, 3);
                gathered.put(l, G::gravity_row, k + constant::gravity_row * L, 1);
            }
            if constexpr (wind) {
                gathered.put(l, G::air, x + loaded::wind * L, 1);
                gathered.put(l, G::turn, x + loaded::turn * L, 1);
                gathered.put(l, G::inverse_weight, k + constant::inverse_weight * L, 1);
            }
            gathered.put(l, G::theta, y + motion::theta * L, 3);
            gathered.put(l, G::rate, y + motion::scaled_rate * L, 3);
            gathered.put(l, G::K, k + constant::K * L, 3);
            gathered.put(l, G::beta, k + constant::beta * L, 1);
            gathered.put(l, G::bend, k + constant::bend * L, 1);
            gathered.put(l, G::twist, k + constant::twist * L, 1);
            gathered.put(l, G::U, frozen_at(one.row, one.lane) + kept::U * L, 9);
            const T mass = l < number ? k[constant::mass * L] : T(0);
            gathered.at[G::mass * L + l] = mass;
            flags.refreshed += mass > 0;
        }
        const Rows<const T> of{gathered.at};
        JointLoad<W> in;
        in.J = of.symmetric(G::J);
        in.theta = of.vector(G::theta);
        in.K = of.vector(G::K);
        in.beta = of.real(G::beta);
        in.bend = of.real(G::bend);
        in.twist = of.real(G::twist);
        W gravity_load{}, wind_load{};
        if constexpr (gravity) {
            in.h = of.vector(G::h);
            in.g = of.vector(G::g);
            in.gravity_row = of.real(G::gravity_row);
            gravity_load = (rows.h * rows.h) * dot(in.h, in.g);
        }
        if constexpr (wind) {
            in.wind_row = of.real(G::air);
            in.turn_row = of.real(G::turn);
            in.inverse_weight = of.real(G::inverse_weight);
            wind_load = rows.h * (in.inverse_weight * in.wind_row) + (rows.h * rows.h) * in.turn_row;
        }
        const V3<W> w = scaled_rate_of(of.matrix(G::U), of.vector(G::rate));
        const M3<W> rates =
            turn_form(in.theta, W(dot(in.theta, in.theta)), all(T(0.5)), t2_of(W(dot(in.theta, in.theta))));
        W weight{};
        const Symmetric<W> KG = joint_stiffness<gravity>(in, rates, weight);
        const JointModes<W> modes = joint_modes<wind>(cholesky(joint_inertia(in)), KG);
        JointLambdas<W> lambdas;
        const FrozenJoint<W> f = frozen_joint<wind, gravity>(in, modes, weight, rows.h, largest_lambda<T>(), lambdas);
        const W mass = of.real(G::mass);
        for (int m = 0; m < 3; ++m) {
            this->count(-lambdas.lambda[m], 0, mass, flags.buckling);
            this->count(lambdas.with_air[m], largest_lambda<T>(), mass, flags.bounded_lambda);
        }

        alignas(64) T out[kept::count * L], rate[3 * L];
        const Rows<T> put{out};
        put.set(kept::U, f.U);
        put.set(kept::E, f.E);
        put.set(kept::B, f.B);
        put.set(kept::carry, f.carry);
        put.set(kept::C, f.C);
        put.set(kept::J, of.symmetric(G::J_parent));
        put.set(kept::gravity, gravity_load);
        put.set(kept::wind, wind_load);
        put.set(kept::sensitivity, f.sensitivity);
        Rows<T>{rate}.set(0, transposed_times(modes.V, w));
        for (int l = 0; l < number; ++l) {
            T* old = frozen_at(first[l].row, first[l].lane);
            for (int k = 0; k < kept::count; ++k) old[k * L] = out[k * L + l];
            T* y = this->motion_at(first[l].row, first[l].lane) + motion::scaled_rate * L;
            for (int k = 0; k < 3; ++k) y[k * L] = rate[k * L + l];
        }
    }

    void step_ready() {
        for (int k = 0; k < stales; k += width<T>) refresh(stale + k, stales - k < width<T> ? stales - k : width<T>);
        stales = 0;
        for (int k = 0; k < readies; ++k) step_joints<W>(ready + k);
        readies = 0;
    }
    void joints_done() {
        step_ready();
        this->step_last();
        this->see_finite();
    }

    template <class X> [[gnu::noinline]] void step_joints(const Place* places) {
        const auto a = this->template at<X>(places);
        Across<X, const T> k;
        for (int j = 0; j < Registers<X>::count; ++j) k.at[j] = frozen_at(places[j].row, places[j].lane);
        const JointLoad<X> in = this->load(a);
        FrozenJoint<X> f;
        f.U = {k.vector(kept::U), k.vector(kept::U + 3), k.vector(kept::U + 6)};
        f.E = k.vector(kept::E);
        f.B = k.vector(kept::B);
        f.carry = k.vector(kept::carry);
        f.C = k.vector(kept::C);
        JointStep<X> step = step_frozen<wind, gravity, forces>(in, f, rows.h);
        this->template finish<true>(a, in, step);
    }
};

} // namespace

template <class T> AnalyticSweeps<T> frozen_sweeps(AnalyticLoads loads) {
    return sweeps_of<FrozenSweep, T>(loads);
}

template AnalyticSweeps<float> frozen_sweeps(AnalyticLoads);
template AnalyticSweeps<double> frozen_sweeps(AnalyticLoads);

} // namespace BOUGH_TARGET
} // namespace bough::fast
