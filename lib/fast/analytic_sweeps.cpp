// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "analytic_sweeps.h"
#include "../stages/oscillator.h"
#include "../stages/turn_guard.h"
#include "sweep_parts.h"
#include "wide_spring.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

namespace motion = analytic::motion;
namespace constant = analytic::constant;
namespace loaded = analytic::loaded;
namespace outward = analytic::outward;
namespace inward = analytic::inward;

// The same part of one row, or of two, as one number.
template <class X> struct Across {
    using T = RealOf<X>;
    T* at[Registers<X>::count];

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

template <class T, bool wind, bool pulls, bool gravity> struct AnalyticSweep : SweepParts<T, AnalyticRows<T>> {
    using Base = SweepParts<T, AnalyticRows<T>>;
    using Base::about_half_turn2;
    using Base::L;
    using Base::prefetch;
    using Base::rows;
    using Base::still_finite2;
    using Base::vector;
    using typename Base::W;

    static constexpr bool forces = wind || pulls;
    static constexpr bool placed = forces || gravity; // something of the world's is felt
    static constexpr int constant_count = analytic::constants(wind), inward_count = analytic::inward_count(wind, pulls);
    using Work = Pair<W>; // two rows at a time

    const Block& block;
    T* scratch;
    SweepFlags& flags;
    W size{};                        // sum of what would not be finite
    std::uint32_t waiting = nothing; // a row whose joints wait for another row's

    AnalyticSweep(const AnalyticRows<T>& r, const Block& b, T* s, SweepFlags& f)
        : Base(r), block(b), scratch(s), flags(f) {}

    T* constants_at(std::uint32_t row, int lane) const {
        return const_cast<T*>(rows.constants) + row * std::size_t(constant_count) * L + lane;
    }
    T* motion_at(std::uint32_t row, int lane) const {
        return rows.motion + row * std::size_t(motion::count) * L + lane;
    }
    T* loaded_at(std::uint32_t row, int lane) const {
        return scratch + (row - block.first_row) * std::size_t(loaded::count) * L + lane;
    }
    Rows<const T> constants_of(std::uint32_t row, int lane) const { return {constants_at(row, lane)}; }
    Rows<T> loaded_of(std::uint32_t row, int lane) const { return {loaded_at(row, lane)}; }

    // ---- outward: where the bodies are, and what loads them (state_update.h, external_forces.h), in their own axes

    struct Frame {
        M3<W> R_bw;
        V3<W> omega, v; // v of the joint
        W y;
    };

    // As SweepParts' profile, the lanes' places looked up at once.
    BOUGH_FORCE W profile_at(const W& y) const {
        using B = Bits<T>;
        const std::size_t last = rows.profile_entries - 1;
        if (last == 0) return all(rows.profile[0]);
        const W place = smaller(larger(W(y * rows.per_metre), W{}), all(T(last))); // NaN: 0
        const W rounded = smaller(W(place - T(0.5)), all(T(last - 1))) + B::rounder;
        const typename B::Wide k = typename B::Wide(rounded) & 0x3fffff;
        const W low = look_up(rows.profile, k), high = look_up(rows.profile + 1, k);
        return low + (place - (rounded - B::rounder)) * (high - low);
    }

    // The air's force over kappa rho A, and its speed (air.h).
    template <Kind kind> BOUGH_FORCE static V3<W> air_force(const V3<W>& u, W& speed) {
        if constexpr (kind == Kind::branch) {
            speed = root(W(u.x * u.x + u.y * u.y));
            return {speed * u.x, speed * u.y, W{}};
        } else {
            speed = root(dot(u, u));
            if constexpr (kind == Kind::fruit) return speed * u;
            return {W{}, speed * u.y, W{}};
        }
    }

    [[gnu::noinline]] void add_pulls(std::uint32_t row, int lane, const M3<W>& R_bw, const Rows<T>& out) const {
        for (auto k = std::size_t(rows.pull_of_row[row]); k < rows.pull_count && rows.pulls[k].row == row; ++k) {
            const PullOnLane<T>& pull = rows.pulls[k];
            const int l = int(pull.lane) - lane;
            if (l < 0 || l >= width<T>) continue;
            const V3<T> x{R_bw.x.x[l], R_bw.x.y[l], R_bw.x.z[l]}, y{R_bw.y.x[l], R_bw.y.y[l], R_bw.y.z[l]},
                z{R_bw.z.x[l], R_bw.z.y[l], R_bw.z.z[l]};
            const V3<T> f = pull.force[0] * x + pull.force[1] * y + pull.force[2] * z;
            const V3<T> tau = cross(V3<T>{pull.point[0], pull.point[1], pull.point[2]}, f);
            const T add[6] = {f.x, f.y, f.z, tau.x, tau.y, tau.z};
            static_assert(loaded::tau == loaded::f + 3);
            for (int j = 0; j < 6; ++j) out.at[(loaded::f + j) * L + l] += add[j];
        }
    }

    template <Kind kind> BOUGH_FORCE void step_out(Frame& f, std::uint32_t row, int lane) const {
        const Rows<const T> k = constants_of(row, lane), y0{motion_at(row, lane)};
        const Rows<T> out = loaded_of(row, lane);
        prefetch(k.at + constant_count * L, constant_count * L);
        prefetch(y0.at + motion::count * L, motion::count * L);
        const V3<W> theta = y0.vector(motion::theta);
        const W q = dot(theta, theta);
        const Turn<W> turn = turn_of(q);
        const M3<W> R = this->joint_rotation(k) * turn_form(theta, q, turn.s, turn.c1);
        out.set(loaded::R_pb, R);
        if constexpr (!placed) return;
        const V3<W> r = k.vector(constant::joint_position);
        if constexpr (wind) {
            f.y = f.y + dot(f.R_bw.y, r);
            f.v = transposed_times(R, f.v + cross(f.omega, r));
            const V3<W> eta = y0.vector(motion::theta_dot), across = cross(theta, eta);
            f.omega = transposed_times(R, f.omega) + eta - turn.c1 * across + turn.c2 * cross(theta, across);
        }
        f.R_bw = {transposed_times(R, f.R_bw.x), transposed_times(R, f.R_bw.y), transposed_times(R, f.R_bw.z)};
        if constexpr (gravity) out.set(loaded::g, f.R_bw * vector(rows.gravity));
        if constexpr (wind) {
            const V3<W> c = k.vector(constant::com);
            const W p = profile_at(f.y + dot(f.R_bw.y, c));
            const V3<W> still = p * (f.R_bw * vector(rows.wind)), moving = still - f.v - cross(f.omega, c);
            const W scale = k.real(constant::drag_area);
            const W still2 = dot(still, still), still_speed = root(still2);
            W speed_0, speed_1;
            const V3<W> f0 = air_force<kind>(still, speed_0), f1 = air_force<kind>(moving, speed_1);
            const V3<W> force = scale * f0;
            out.set(loaded::f, force);
            out.set(loaded::tau, cross(c, force));
            out.set(loaded::drag_f, scale * (f1 - f0));
            const W sway = scale * k.real(constant::sway);
            out.set(loaded::drag, W(sway * (speed_1 + speed_0)));
            out.set(loaded::wind, W(sway * still_speed));
            constexpr T turns = kind == Kind::branch ? T(3) : kind == Kind::leaf ? T(2) : T(1);
            out.set(loaded::turn, W(turns * scale * still2));
        } else if constexpr (pulls) {
            for (int j = 0; j < 6; ++j) out.set(loaded::f + j, W{});
        }
        if constexpr (forces)
            if (rows.pulls && rows.pull_of_row[row] >= 0) add_pulls(row, lane, f.R_bw, out);
    }

    template <Kind kind> void group_out(const Group& g) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, outward::count> base;
            Frame f{};
            const Rows<T> q = base.rows();
            if constexpr (placed) {
                base.gather(rows.outward_records, &rows.base[g.first_base + std::size_t(lane)]);
                f = {q.matrix(outward::R_bw), q.vector(outward::omega), q.vector(outward::v), q.real(outward::y)};
            }
            for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                step_out<kind>(f, row, lane);
                if (!placed || rows.fork_of_row[row] < 0) continue;
                q.set(outward::R_bw, f.R_bw);
                q.set(outward::omega, f.omega);
                q.set(outward::v, f.v);
                q.set(outward::y, f.y);
                base.scatter(&rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)], 0,
                             [&](std::uint32_t joint, int k, W w) {
                                 write(rows.outward_records + joint * record(outward::count, L) + std::size_t(k), w);
                             });
            }
        }
    }

    // ---- inward: composites (composite.h)

    struct Composite {
        V3<W> h;
        Symmetric<W> J;
        W mass;
        V3<W> f, tau, drag_f, drag_tau;
        W drag, drag_row, wind_, wind_row, turn, turn_row;
    };

    BOUGH_FORCE static void add(Composite& q, const Rows<T>& more) {
        q.h = q.h + more.vector(inward::h);
        q.J = q.J + more.symmetric(inward::J);
        q.mass = q.mass + more.real(inward::mass);
        if constexpr (forces) {
            q.f = q.f + more.vector(inward::f);
            q.tau = q.tau + more.vector(inward::tau);
        }
        if constexpr (wind) {
            q.drag_f = q.drag_f + more.vector(inward::drag_f);
            q.drag_tau = q.drag_tau + more.vector(inward::drag_tau);
            q.drag = q.drag + more.real(inward::drag);
            q.drag_row = q.drag_row + more.real(inward::drag_row);
            q.wind_ = q.wind_ + more.real(inward::wind);
            q.wind_row = q.wind_row + more.real(inward::wind_row);
            q.turn = q.turn + more.real(inward::turn);
            q.turn_row = q.turn_row + more.real(inward::turn_row);
        }
    }
    BOUGH_FORCE static void keep(const Composite& q, const Rows<T>& out) {
        out.set(inward::h, q.h);
        out.set(inward::J, q.J);
        out.set(inward::mass, q.mass);
        if constexpr (forces) {
            out.set(inward::f, q.f);
            out.set(inward::tau, q.tau);
        }
        if constexpr (wind) {
            out.set(inward::drag_f, q.drag_f);
            out.set(inward::drag_tau, q.drag_tau);
            out.set(inward::drag, q.drag);
            out.set(inward::drag_row, q.drag_row);
            out.set(inward::wind, q.wind_);
            out.set(inward::wind_row, q.wind_row);
            out.set(inward::turn, q.turn);
            out.set(inward::turn_row, q.turn_row);
        }
    }

    BOUGH_FORCE void step_in(Composite& q, std::uint32_t row, int lane) const {
        const Rows<const T> k = constants_of(row, lane);
        const Rows<T> io = loaded_of(row, lane);
        const M3<W> R = io.matrix(loaded::R_pb);
        const V3<W> c = k.vector(constant::com);
        const W mass = k.real(constant::mass);
        q.h = q.h + mass * c;
        q.J = q.J + k.symmetric(constant::inertia_joint);
        q.mass = q.mass + mass;
        io.set(loaded::J, q.J);
        io.set(loaded::h, q.h);
        if constexpr (forces) {
            q.f = q.f + io.vector(loaded::f);
            q.tau = q.tau + io.vector(loaded::tau);
            io.set(loaded::tau, q.tau);
        }
        if constexpr (wind) {
            const V3<W> f = io.vector(loaded::drag_f);
            q.drag_f = q.drag_f + f;
            q.drag_tau = q.drag_tau + cross(c, f);
            io.set(loaded::drag_f, q.drag_tau);
            const W arm = k.real(constant::com_distance), drag = io.real(loaded::drag), wind_ = io.real(loaded::wind),
                    turn = io.real(loaded::turn);
            q.drag = q.drag + drag;
            q.wind_ = q.wind_ + wind_;
            q.turn = q.turn + turn;
            q.drag_row = q.drag_row + arm * drag;
            q.wind_row = q.wind_row + arm * wind_;
            q.turn_row = q.turn_row + arm * turn;
            io.set(loaded::drag, q.drag_row);
            io.set(loaded::wind, q.wind_row);
            io.set(loaded::turn, q.turn_row);
        }
        // To the parent's joint, in its body's axes.
        const V3<W> r = k.vector(constant::joint_position);
        const V3<W> h = R * q.h, way = T(0.5) * q.mass * r, p = h + way;
        const W xx = r.x * p.x, yy = r.y * p.y, zz = r.z * p.z;
        const Symmetric<W> J = turned(R, q.J);
        q.J = {J.xx + 2 * (yy + zz), J.xy - (r.x * p.y + r.y * p.x), J.xz - (r.x * p.z + r.z * p.x),
               J.yy + 2 * (xx + zz), J.yz - (r.y * p.z + r.z * p.y), J.zz + 2 * (xx + yy)};
        q.h = p + way;
        if constexpr (forces) {
            q.f = R * q.f;
            q.tau = R * q.tau + cross(r, q.f);
        }
        if constexpr (wind) {
            q.drag_f = R * q.drag_f;
            q.drag_tau = R * q.drag_tau + cross(r, q.drag_f);
            const W distance = k.real(constant::joint_distance);
            q.drag_row = q.drag_row + distance * q.drag;
            q.wind_row = q.wind_row + distance * q.wind_;
            q.turn_row = q.turn_row + distance * q.turn;
        }
    }

    void group_in(const Group& g) {
        for (int lane = 0; lane < L; lane += width<T>) {
            Composite q{};
            for (std::uint32_t k = g.length; k-- > 0;) {
                const std::uint32_t row = g.first_row + k;
                if (rows.fork_of_row[row] >= 0) {
                    Records<T, inward_count> forks;
                    forks.gather(rows.inward_records,
                                 &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)]);
                    add(q, forks.rows());
                }
                step_in(q, row, lane);
                if ((g.length - k) % 2 == 0) step_joints<Work>(row, row + 1, lane); // while both are at hand
            }
            Records<T, inward_count> base;
            keep(q, base.rows());
            for (int k = inward_count; k < base.quantities; ++k) base.rows().set(k, W{});
            base.scatter(&rows.landing[g.first_base + std::size_t(lane)], nothing,
                         [&](std::uint32_t joint, int k, W w) {
                             T* at = rows.inward_records + joint * record(inward_count, L) + std::size_t(k);
                             write(at, read(at) + w);
                         });
        }
        if (g.length % 2 == 0) return;
        if (waiting == nothing) {
            waiting = g.first_row;
            return;
        }
        for (int lane = 0; lane < L; lane += width<T>) step_joints<Work>(waiting, g.first_row, lane);
        waiting = nothing;
    }

    // ---- the joints' own steps (spring.h)

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

    // What the rates keep where a large turn has gained energy (spring.h).
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

    template <class X> [[gnu::noinline]] void step_joints(std::uint32_t one, std::uint32_t other, int lane) {
        using P = Registers<X>;
        Across<X> k, y, l;
        for (int j = 0; j < P::count; ++j) {
            const std::uint32_t row = j ? other : one;
            k.at[j] = constants_at(row, lane);
            y.at[j] = motion_at(row, lane);
            l.at[j] = loaded_at(row, lane);
        }
        JointLoad<X> in;
        in.J = l.symmetric(loaded::J);
        if constexpr (gravity) {
            in.h = l.vector(loaded::h);
            in.g = l.vector(loaded::g);
            in.gravity_row = k.real(constant::gravity_row);
        }
        if constexpr (forces) in.tau = l.vector(loaded::tau);
        if constexpr (wind) {
            in.drag_tau = l.vector(loaded::drag_f);
            in.drag_row = l.real(loaded::drag);
            in.wind_row = l.real(loaded::wind);
            in.turn_row = l.real(loaded::turn);
            in.inverse_weight = k.real(constant::inverse_weight);
        }
        in.theta = y.vector(motion::theta);
        in.rate = y.vector(motion::scaled_rate);
        in.K = k.vector(constant::K);
        in.beta = k.real(constant::beta);
        in.bend = k.real(constant::bend);
        in.twist = k.real(constant::twist);
        JointStep<X> step = step_joint<wind, gravity, forces>(in, rows.h, largest_lambda<T>());

        const X softest = -larger(larger(-step.lambda[0], -step.lambda[1]), -step.lambda[2]);
        if (any_above(X{}, softest) || step.bounded)
            for (int m = 0; m < 3; ++m)
                for (int j = 0; j < Registers<X>::count; ++j) {
                    const W mass = read<T>(k.at[j] + constant::mass * L);
                    count(-Registers<X>::part(step.lambda[m], j), 0, mass, flags.buckling);
                    count(Registers<X>::part(step.with_air[m], j), largest_lambda<T>(), mass, flags.bounded_lambda);
                }
        V3<X> theta = step.theta;
        X q = dot(theta, theta);
        if (any_above(q, each<X>(about_half_turn2))) {
            for (int j = 0; j < P::count; ++j) {
                const V3<W> t{P::part(theta.x, j), P::part(theta.y, j), P::part(theta.z, j)};
                const V3<W> s = shorter(t, read<T>(k.at[j] + constant::mass * L));
                P::part(theta.x, j) = s.x, P::part(theta.y, j) = s.y, P::part(theta.z, j) = s.z;
            }
            q = dot(theta, theta);
        }
        if (any_above(dot(step.phi, step.phi), each<X>(guarded2))) {
            const X mass = k.real(constant::mass), keep = kept(in, step, theta, &mass);
            step.rate = keep * step.rate;
            step.omega = keep * step.omega;
        }
        const V3<X> theta_dot = rate_of(theta, q, step.omega);
        y.set(motion::theta, theta);
        y.set(motion::theta_dot, theta_dot);
        y.set(motion::scaled_rate, step.rate);
        const X all_of_it = q + dot(theta_dot, theta_dot);
        for (int j = 0; j < P::count; ++j) size = size + P::part(all_of_it, j);
    }

    // ---- a block

    void finish() {
        if (waiting != nothing)
            for (int lane = 0; lane < L; lane += width<T>) step_joints<W>(waiting, waiting, lane);
        waiting = nothing;
        if (!(total(size) < still_finite2)) flags.finite = false;
    }

    void out() {
        T* forks = rows.inward_records + block.first_fork * record(inward_count, L);
        std::memset(forks, 0, (block.end_fork - block.first_fork) * record(inward_count, L) * sizeof(T));
        for (std::uint32_t k = block.first_group; k < block.end_group; ++k) {
            const Group& g = rows.groups[k];
            if (!wind || g.kind == Kind::branch)
                group_out<Kind::branch>(g);
            else if constexpr (wind) {
                if (g.kind == Kind::fruit)
                    group_out<Kind::fruit>(g);
                else
                    group_out<Kind::leaf>(g);
            }
            if (k >= block.terminal_group) group_in(g);
        }
        finish();
    }
    void in() {
        for (std::uint32_t k = block.terminal_group; k-- > block.first_group;) group_in(rows.groups[k]);
        finish();
    }
};

template <class T, bool wind, bool pulls, bool gravity>
void outward_sweep(const AnalyticRows<T>& rows, const Block& block, T* scratch, SweepFlags& flags) {
    const FlushToZero flush;
    AnalyticSweep<T, wind, pulls, gravity>(rows, block, scratch, flags).out();
}
template <class T, bool wind, bool pulls, bool gravity>
void inward_sweep(const AnalyticRows<T>& rows, const Block& block, T* scratch, SweepFlags& flags) {
    const FlushToZero flush;
    AnalyticSweep<T, wind, pulls, gravity>(rows, block, scratch, flags).in();
}

template <class T, bool wind, bool pulls> AnalyticSweeps<T> with_gravity(bool gravity) {
    if (gravity) return {outward_sweep<T, wind, pulls, true>, inward_sweep<T, wind, pulls, true>};
    return {outward_sweep<T, wind, pulls, false>, inward_sweep<T, wind, pulls, false>};
}

} // namespace

template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads loads) {
    if (loads.wind) return with_gravity<T, true, false>(loads.gravity); // it has forces, and so room for pulls
    return loads.pulls ? with_gravity<T, false, true>(loads.gravity) : with_gravity<T, false, false>(loads.gravity);
}

template AnalyticSweeps<float> analytic_sweeps(AnalyticLoads);
template AnalyticSweeps<double> analytic_sweeps(AnalyticLoads);

} // namespace BOUGH_TARGET
} // namespace bough::fast
