// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "coupled_sweeps.h"
#include "sweep_parts.h"
#include <algorithm>

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

template <class T> struct Sweep : SweepParts<T> {
    using Parts = SweepParts<T>;
    using Parts::about_half_turn2;
    using Parts::constants;
    using Parts::L;
    using Parts::next;
    using Parts::now;
    using Parts::number;
    using Parts::prefetch;
    using Parts::rows;
    using Parts::solved_row;
    using Parts::still_finite2;
    using Parts::vector;
    using typename Parts::C;
    using typename Parts::W;

    explicit Sweep(const CoupledRows<T>& r) : Parts(r) {}

    // ---- outward: where the body is half a step on, and what it is loaded with

    struct Frame { // of a body, at y*
        M3<W> R;
        W y;
        V3<W> omega, v, ahead_omega, ahead_v, own, turn, alpha, a;
    };

    BOUGH_FORCE static Frame read_frame(Records<T, outward::count>& r) {
        const Rows<T> q = r.rows();
        return {q.matrix(outward::R),           q.real(outward::y),
                q.vector(outward::omega),       q.vector(outward::v),
                q.vector(outward::ahead_omega), q.vector(outward::ahead_v),
                q.vector(outward::own),         q.vector(outward::turn),
                q.vector(outward::alpha),       q.vector(outward::a)};
    }
    BOUGH_FORCE static void write_frame(Records<T, outward::count>& r, const Frame& f) {
        const Rows<T> q = r.rows();
        q.set(outward::R, f.R);
        q.set(outward::y, f.y);
        q.set(outward::omega, f.omega);
        q.set(outward::v, f.v);
        q.set(outward::ahead_omega, f.ahead_omega);
        q.set(outward::ahead_v, f.ahead_v);
        q.set(outward::own, f.own);
        q.set(outward::turn, f.turn);
        q.set(outward::alpha, f.alpha);
        q.set(outward::a, f.a);
    }

    // Square of the rate from which on the energy guard looks at a tree.
    W fast2() const { return all(T(watched_turn) / rows.h * (T(watched_turn) / rows.h)); }
    [[gnu::noinline]] void mark(std::uint32_t base, int lane, W rate2, SweepFlags& flags) const {
        flags.fast = true;
        for (int l = 0; l < width<T>; ++l)
            if (rate2[l] > fast2()[l]) rows.watched[base + std::uint32_t(lane + l)] = 1;
    }

    // resolved_turn.h
    [[gnu::noinline]] static V3<W> bounded(V3<W> omega, W turn2, W mass, std::uint64_t& count) {
        V3<W> out = omega;
        const W scale = 1 / root(turn2);
        for (int l = 0; l < width<T>; ++l)
            if (turn2[l] > 1) {
                out.x[l] *= scale[l];
                out.y[l] *= scale[l];
                out.z[l] *= scale[l];
                if (mass[l] > 0) ++count;
            }
        return out;
    }
    BOUGH_FORCE static V3<W> resolved(const V3<W>& omega, T h, W mass, std::uint64_t& count) {
        const W turn2 = (h * h) * dot(omega, omega);
        return any_above(turn2, all(T(1))) ? bounded(omega, turn2, mass, count) : omega;
    }

    // What they ask for. By value, as what a function is given the place of cannot stay in registers.
    struct Pulls {
        V3<C> N, F;
    };
    [[gnu::noinline]] Pulls pulls_on(std::uint32_t row, int lane, M3<W> R) const {
        Pulls out{};
        for (auto k = std::size_t(rows.pull_of_row[row]); k < rows.pull_count && rows.pulls[k].row == row; ++k) {
            const PullOnLane<T>& pull = rows.pulls[k];
            const int l = int(pull.lane) - lane;
            if (l < 0 || l >= width<T>) continue;
            const V3<T> r = V3<T>{R.x.x[l], R.x.y[l], R.x.z[l]}, s{R.y.x[l], R.y.y[l], R.y.z[l]},
                        t{R.z.x[l], R.z.y[l], R.z.z[l]};
            const V3<T> arm = pull.point[0] * r + pull.point[1] * s + pull.point[2] * t;
            const V3<T> f{pull.force[0], pull.force[1], pull.force[2]},
                c{pull.change[0], pull.change[1], pull.change[2]};
            const V3<T> fr = f + rows.slope[0] * c, fi = rows.slope[1] * c;
            const V3<T> nr = cross(arm, fr), ni = cross(arm, fi);
            out.F.x.re[l] -= fr.x, out.F.y.re[l] -= fr.y, out.F.z.re[l] -= fr.z;
            out.F.x.im[l] -= fi.x, out.F.y.im[l] -= fi.y, out.F.z.im[l] -= fi.z;
            out.N.x.re[l] -= nr.x, out.N.y.re[l] -= nr.y, out.N.z.re[l] -= nr.z;
            out.N.x.im[l] -= ni.x, out.N.y.im[l] -= ni.y, out.N.z.im[l] -= ni.z;
        }
        return out;
    }

    // One row: the frame of its bodies from their parents'.
    template <bool wind, bool gravity, Kind kind>
    BOUGH_FORCE void step_out(Frame& f, std::uint32_t row, std::uint32_t row_base, int lane, const Rows<T>& out,
                              W& fastest, SweepFlags& flags) const {
        const Rows<const T> k = constants(row, lane), y0 = now(row, lane);
        prefetch(k.at + constant::count * L, constant::count * L);
        prefetch(y0.at + motion::count * L, motion::count * L);
        const T h = rows.h;
        const W mass = k.real(constant::mass);
        const V3<W> theta_0 = y0.vector(motion::theta), eta_0 = y0.vector(motion::theta_dot);

        const M3<W> G = f.R * this->joint_rotation(k);
        V3<W> half, half_rate;
        this->halfway(y0, G, f.turn, half, half_rate);
        const V3<W> theta = theta_0 + half, eta = eta_0 + half_rate;
        const WideMaps<T> maps = wide_maps<T>(theta);
        const M3<W> GJ = G * maps.J;
        const M3<W> rates = maps.J_inverse * transposed(G);
        const V3<W> r = f.R * k.vector(constant::joint_position);
        const M3<W> R = G * maps.R;
        const V3<W> c = R * k.vector(constant::com);
        W wind_factor{};
        if constexpr (wind) {
            f.y = f.y + r.y;
            wind_factor = this->profile(f.y + c.y);
        }
        const V3<W> w_0 = GJ * eta_0, w_ahead = GJ * half_rate, w = w_0 + w_ahead;

        const V3<W> spin_p = resolved(f.omega, h, mass, flags.fast_turns),
                    turning = resolved(w, h, mass, flags.fast_turns);
        const V3<W> alpha =
            f.alpha + cross(spin_p, turning) + G * maps.rate_bias(resolved(eta, h, mass, flags.fast_turns));
        f.a = f.a + cross(f.alpha, r) + cross(spin_p, cross(spin_p, r));
        f.alpha = alpha;
        f.v = f.v + cross(f.omega, r);
        f.ahead_v = f.ahead_v + cross(f.ahead_omega, r);
        f.omega = f.omega + w;
        f.ahead_omega = f.ahead_omega + w_ahead;
        f.own = f.own + w_0;
        f.turn = f.turn + GJ * half;
        f.R = R;
        const W omega2 = dot(f.omega, f.omega);
        fastest = larger(omega2, fastest);
        if (any_above(omega2, fast2())) mark(row_base, lane, omega2, flags);

        V3<W> u{};
        typename Parts::Speed speed{};
        if constexpr (wind) {
            u = wind_factor * vector(rows.wind) - f.v - cross(f.omega, c);
            speed = Parts::template air_speed<kind>(u, R);
        }

        // The joint's spring and damper, while the air's speed is on its way.
        const V3<W> K = k.vector(constant::K);
        const M3<W> KT{{K.x * rates.x.x, K.y * rates.x.y, K.z * rates.x.z},
                       {K.x * rates.y.x, K.y * rates.y.y, K.z * rates.y.z},
                       {K.x * rates.z.x, K.y * rates.z.y, K.z * rates.z.z}};
        const V3<W> bent = theta_0 + W(k.real(constant::beta) + rows.s1[0]) * eta_0;
        out.set(loaded::torque, complex(-transposed_times(KT, bent), -(rows.s1[1] * transposed_times(KT, eta_0))));
        out.set(loaded::K, symmetric_transposed_product(rates, KT));
        out.set(loaded::c, c);
        out.set(loaded::r, r);
        const auto keep = [&](const auto& to) {
            to.set(solved::rates, rates);
            to.set(solved::r, r);
        };
        if (rows.stream)
            keep(Rows<T, true>{solved_row(row, lane).at});
        else
            keep(solved_row(row, lane));

        // body_load.h
        std::uint64_t seen = 0; // counted at the next body's turn about it
        const V3<W> spin = resolved(f.omega, h, mass, seen);
        const V3<W> g = vector(rows.gravity);
        const Symmetric<W> J = turned(R, k.symmetric(constant::inertia_joint));
        out.set(loaded::J, J);
        Symmetric<W> H{};
        V3<W> a0 = f.a;
        if constexpr (gravity) {
            const V3<W> P = R * k.vector(constant::carried_moment);
            const W Pg = dot(P, g);
            H = {Pg - P.x * g.x, T(-0.5) * (P.x * g.y + P.y * g.x), T(-0.5) * (P.x * g.z + P.z * g.x),
                 Pg - P.y * g.y, T(-0.5) * (P.y * g.z + P.z * g.y), Pg - P.z * g.z};
            a0 = a0 - g;
        }
        const V3<W> turning_N = J * alpha + cross(spin, J * spin);
        const V3<W> turning_F = mass * (cross(alpha, c) + cross(spin, cross(spin, c)));
        V3<W> at_com = mass * a0, slope{}; // [N] what is to be turned about the joint: all but the body's own turning
        if constexpr (wind) {
            const V3<W> ahead = f.ahead_v + cross(f.ahead_omega, c);
            const V3<W> com = k.vector(constant::com);
            const W arm = kind == Kind::leaf ? root(dot(com, com)) : W{};
            const auto air_on = Parts::template air<kind>(u, speed, ahead, R, k.real(constant::drag_area), H, arm);
            out.set(loaded::D, air_on.D);
            const V3<W> slope_F = air_on.D * (wind_factor * vector(rows.wind_change));
            at_com = at_com - air_on.force - rows.slope[0] * slope_F;
            slope = -(rows.slope[1] * slope_F);
        }
        V3<C> F = complex(turning_F + at_com, slope), N = complex(turning_N + cross(c, at_com), cross(c, slope));
        if constexpr (gravity || (wind && kind == Kind::leaf)) {
            const V3<W> bent_by = f.turn - rows.s1[0] * f.own, back = H * bent_by, ahead_back = rows.s1[1] * (H * f.own);
            N = complex(V3<W>{N.x.re - back.x, N.y.re - back.y, N.z.re - back.z},
                        V3<W>{N.x.im + ahead_back.x, N.y.im + ahead_back.y, N.z.im + ahead_back.z});
        }
        if constexpr (gravity || wind) out.set(loaded::H, H);
        if (rows.pulls && rows.pull_of_row[row] >= 0) {
            const Pulls pulls = pulls_on(row, lane, R);
            N = N + pulls.N;
            F = F + pulls.F;
        }
        out.set(loaded::N, N);
        out.set(loaded::F, F);
    }

    // ---- inward: what each joint hands on

    struct Carried {
        Symmetric<C> A, M;
        M3<C> B;
        V3<C> N, F;
    };

    BOUGH_FORCE static Carried read_carried(const Rows<T>& q) {
        return {q.complex_symmetric(inward::A), q.complex_symmetric(inward::M), q.complex_matrix(inward::B),
                q.complex_vector(inward::N), q.complex_vector(inward::F)};
    }

    template <bool wind, bool gravity, bool stream>
    BOUGH_FORCE void step_in(Carried& q, std::uint32_t row, int lane, const Rows<const T>& in) const {
        const Rows<const T> k = constants(row, lane);
        const W mass = k.real(constant::mass);
        const C s1 = number(rows.s1), s2 = number(rows.s2);
        const V3<W> c = in.vector(loaded::c);
        // Own A, B, M beside those that came (resolvent.cpp, start)
        const Symmetric<W> J = in.symmetric(loaded::J), K = in.symmetric(loaded::K);
        q.A = {q.A.xx + J.xx, q.A.xy + J.xy, q.A.xz + J.xz, q.A.yy + J.yy, q.A.yz + J.yz, q.A.zz + J.zz};
        if constexpr (gravity || wind) q.A = plus(q.A, s2, in.symmetric(loaded::H));
        M3<C>& B = q.B;
        if constexpr (wind) {
            const Symmetric<W> D = in.symmetric(loaded::D);
            const M3<W> cD = cross_left(c, full(D));
            q.A = plus(q.A, s1, upper(cross_left(c, transposed(cD))));
            q.M = plus(q.M, s1, D);
            B = {plus(B.x, s1, cD.x), plus(B.y, s1, cD.y), plus(B.z, s1, cD.z)};
        }
        const V3<W> mc = mass * c;
        B.x.y = B.x.y + mc.z, B.x.z = B.x.z - mc.y;
        B.y.x = B.y.x - mc.z, B.y.z = B.y.z + mc.x;
        B.z.x = B.z.x + mc.y, B.z.y = B.z.y - mc.x;
        q.M.xx = q.M.xx + mass, q.M.yy = q.M.yy + mass, q.M.zz = q.M.zz + mass;
        q.N = q.N + in.complex_vector(loaded::N);
        q.F = q.F + in.complex_vector(loaded::F);

        const C z = k.real(constant::beta) * s1 + s2;
        const W size = J.xx + J.yy + J.zz + (magnitude(z.re) + magnitude(z.im)) * (K.xx + K.yy + K.zz);
        const Symmetric<C> E = inverse(plus(q.A, z, K), W(1 / size));
        const auto keep = [&](int quantity, const auto& v) {
            Rows<T, stream>{solved_row(row, lane).at}.set(quantity, v);
        };
        // A' = Z E A, B' = Z E B, M' = M - B^T E B, column by column, so that little has to stay in registers.
        const V3<W> Kx{K.xx, K.xy, K.xz}, Ky{K.xy, K.yy, K.yz}, Kz{K.xz, K.yz, K.zz};
        const V3<C> Ax{q.A.xx, q.A.xy, q.A.xz}, Ay{q.A.xy, q.A.yy, q.A.yz}, Az{q.A.xz, q.A.yz, q.A.zz};
        const V3<C> EAx = E * Ax;
        keep(solved::EA, EAx);
        Symmetric<C> A;
        A.xx = z * dot(Kx, EAx);
        const V3<C> EAy = E * Ay;
        keep(solved::EA + 6, EAy);
        A.xy = z * dot(Kx, EAy);
        A.yy = z * dot(Ky, EAy);
        const V3<C> EAz = E * Az;
        keep(solved::EA + 12, EAz);
        A.xz = z * dot(Kx, EAz);
        A.yz = z * dot(Ky, EAz);
        A.zz = z * dot(Kz, EAz);

        Symmetric<C>& M = q.M;
        M3<C> B1;
        const V3<C> EBx = E * B.x;
        keep(solved::EB, EBx);
        B1.x = z * (K * EBx);
        M.xx = minus_dot(M.xx, B.x, EBx);
        const V3<C> EBy = E * B.y;
        keep(solved::EB + 6, EBy);
        B1.y = z * (K * EBy);
        M.xy = minus_dot(M.xy, B.x, EBy);
        M.yy = minus_dot(M.yy, B.y, EBy);
        const V3<C> EBz = E * B.z;
        keep(solved::EB + 12, EBz);
        B1.z = z * (K * EBz);
        M.xz = minus_dot(M.xz, B.x, EBz);
        M.yz = minus_dot(M.yz, B.y, EBz);
        M.zz = minus_dot(M.zz, B.z, EBz);

        const V3<C> Eu = E * (in.complex_vector(loaded::torque) - q.N);
        keep(solved::Eu, Eu);
        const V3<W> r = in.vector(loaded::r);
        q.N = {plus_dot(q.N.x, Ax, Eu), plus_dot(q.N.y, Ay, Eu), plus_dot(q.N.z, Az, Eu)};
        q.F = {plus_dot(q.F.x, B.x, Eu), plus_dot(q.F.y, B.y, Eu), plus_dot(q.F.z, B.z, Eu)};
        q.N = plus_cross(q.N, r, q.F);
        // To the parent's joint: B'' = B' + [r] M', A'' = A' + S + S^T with S = [r] (B' + B'')^T / 2.
        B = {plus_cross(B1.x, r, V3<C>{M.xx, M.xy, M.xz}), plus_cross(B1.y, r, V3<C>{M.xy, M.yy, M.yz}),
             plus_cross(B1.z, r, V3<C>{M.xz, M.yz, M.zz})};
        const M3<C> U = B1 + B;
        const V3<W> t = T(0.5) * r;
        q.A.xx = minus(plus(A.xx, r.y, U.z.x), r.z, U.y.x);
        q.A.yy = minus(plus(A.yy, r.z, U.x.y), r.x, U.z.y);
        q.A.zz = minus(plus(A.zz, r.x, U.y.z), r.y, U.x.z);
        q.A.xy = minus(plus(minus(plus(A.xy, t.y, U.z.y), t.z, U.y.y), t.z, U.x.x), t.x, U.z.x);
        q.A.xz = minus(plus(minus(plus(A.xz, t.y, U.z.z), t.z, U.y.z), t.x, U.y.x), t.y, U.x.x);
        q.A.yz = minus(plus(minus(plus(A.yz, t.z, U.x.z), t.x, U.z.z), t.x, U.y.y), t.y, U.x.y);
    }

    template <bool wind, bool gravity, bool stream>
    void group_in(const Group& g, const T* loaded_rows) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Carried q{};
            for (std::uint32_t k = g.length; k-- > 0;) {
                const std::uint32_t row = g.first_row + k;
                if (rows.fork_of_row[row] >= 0) {
                    Records<T, inward::count> forks;
                    forks.gather(rows.inward_records,
                                 &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)]);
                    const Carried more = read_carried(forks.rows());
                    q = {q.A + more.A, q.M + more.M, q.B + more.B, q.N + more.N, q.F + more.F};
                }
                step_in<wind, gravity, stream>(
                    q, row, lane, {loaded_rows + std::size_t(row - g.first_row) * loaded::count * L + lane});
            }
            Records<T, inward::count> base;
            const Rows<T> out = base.rows();
            out.set(inward::A, q.A);
            out.set(inward::M, q.M);
            out.set(inward::B, q.B);
            out.set(inward::N, q.N);
            out.set(inward::F, q.F);
            for (int k = inward::count; k < base.quantities; ++k) out.set(k, W{});
            base.scatter(&rows.landing[g.first_base + std::size_t(lane)], nothing,
                         [&](std::uint32_t joint, int k, W w) {
                             T* at = rows.inward_records + joint * record(inward::count, L) + std::size_t(k);
                             write(at, read(at) + w);
                         });
        }
    }

    template <bool wind, bool gravity> void any_group_in(const Group& g, const T* loaded_rows) const {
        if (rows.stream)
            group_in<wind, gravity, true>(g, loaded_rows);
        else
            group_in<wind, gravity, false>(g, loaded_rows);
    }

    template <bool wind, bool gravity, Kind kind>
    void group_out(const Group& g, T* loaded_rows, SweepFlags& flags) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, outward::count> base;
            base.gather(rows.outward_records, &rows.base[g.first_base + std::size_t(lane)]);
            Frame f = read_frame(base);
            W fastest{};
            for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                step_out<wind, gravity, kind>(f, row, g.first_base, lane,
                                              {loaded_rows + std::size_t(row - g.first_row) * loaded::count * L + lane},
                                              fastest, flags);
                if (rows.fork_of_row[row] < 0) continue;
                write_frame(base, f);
                base.scatter(&rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)], 0,
                             [&](std::uint32_t joint, int k, W w) {
                                 write(rows.outward_records + joint * record(outward::count, L) + std::size_t(k), w);
                             });
            }
            for (int l = 0; l < width<T>; ++l) flags.omega2 = std::max(flags.omega2, double(fastest[l]));
        }
    }

    static std::size_t place(const Block& block, const Group& g) {
        return std::size_t(g.first_row - block.first_row) * loaded::count * L;
    }

    template <bool wind, bool gravity> void block_out(const Block& block, T* scratch, SweepFlags& flags) const {
        T* forks = rows.inward_records + block.first_fork * record(inward::count, L);
        std::memset(forks, 0, (block.end_fork - block.first_fork) * record(inward::count, L) * sizeof(T));
        for (std::uint32_t k = block.first_group; k < block.end_group; ++k) {
            const Group& g = rows.groups[k];
            // A terminal group is done with before the next one begins: all of them take the same place.
            T* loaded_rows = scratch + place(block, rows.groups[std::min(k, block.terminal_group)]);
            if constexpr (!wind)
                group_out<wind, gravity, Kind::branch>(g, loaded_rows, flags);
            else if (g.kind == Kind::branch)
                group_out<wind, gravity, Kind::branch>(g, loaded_rows, flags);
            else if (g.kind == Kind::fruit)
                group_out<wind, gravity, Kind::fruit>(g, loaded_rows, flags);
            else
                group_out<wind, gravity, Kind::leaf>(g, loaded_rows, flags);
            if (k >= block.terminal_group) any_group_in<wind, gravity>(g, loaded_rows);
        }
    }

    template <bool wind, bool gravity> void block_in(const Block& block, const T* scratch) const {
        for (std::uint32_t k = block.terminal_group; k-- > block.first_group;)
            any_group_in<wind, gravity>(rows.groups[k], scratch + place(block, rows.groups[k]));
    }

    // ---- outward again: accelerations, and the step's end

    [[gnu::noinline]] void turn_back(const Rows<T>& out, SweepFlags& flags, W mass) const {
        for (int l = 0; l < width<T>; ++l) {
            T v[motion::count];
            for (int k = 0; k < motion::count; ++k) v[k] = out.at[k * L + l];
            if (!(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] > about_half_turn2)) continue;
            if (!rows.shorten(v + motion::theta, v + motion::theta_dot, v + motion::theta_change,
                              v + motion::theta_dot_change, rows.h))
                continue;
            if (mass[l] > 0) ++flags.half_turns;
            for (int k = 0; k < motion::count; ++k) out.at[k * L + l] = v[k];
        }
    }

    template <bool stream> void group_accelerate(const Group& g, SweepFlags& flags) const {
        const C of_rate = number(rows.of_rate), of_angle = number(rows.of_angle);
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, accelerated::count> base;
            base.gather(rows.accelerated_records, &rows.base[g.first_base + std::size_t(lane)]);
            W sizes{};
            V3<C> alpha = base.rows().complex_vector(accelerated::alpha),
                  a = base.rows().complex_vector(accelerated::a);
            for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                const Rows<T> s = solved_row(row, lane);
                prefetch(s.at + solved::count * L, solved::count * L);
                prefetch(now(row + 1, lane).at, 2 * motion::theta_dot * L);
                a = a - cross(s.vector(solved::r), alpha);
                const V3<C> gamma = s.complex_vector(solved::Eu) - s.complex_matrix(solved::EA) * alpha -
                                    s.complex_matrix(solved::EB) * a;
                alpha = alpha + gamma;
                const V3<C> x = s.matrix(solved::rates) * gamma;
                const Rows<const T> y0 = now(row, lane);
                const V3<W> theta_0 = y0.vector(motion::theta), eta_0 = y0.vector(motion::theta_dot);
                const auto weighed = [](const C& k, const V3<C>& v) {
                    return V3<W>{k.re * v.x.re - k.im * v.x.im, k.re * v.y.re - k.im * v.y.im,
                                 k.re * v.z.re - k.im * v.z.im};
                };
                V3<W> rate_change = weighed(of_rate, x), change = weighed(of_angle, x) + rows.eta * eta_0;
                const Rows<T> y1 = next(row, lane);
                if (rows.adds) {
                    rate_change = y1.vector(motion::theta_dot_change) + rate_change;
                    change = y1.vector(motion::theta_change) + change;
                }
                const V3<W> theta = theta_0 + change, eta = eta_0 + rate_change;
                const Rows<T, stream> to{y1.at};
                to.set(motion::theta, theta);
                to.set(motion::theta_dot, eta);
                to.set(motion::theta_change, change);
                to.set(motion::theta_dot_change, rate_change);
                const W angle2 = dot(theta, theta), rate2 = dot(eta, eta);
                if (rows.ends) {
                    // As the plain step looks at theta_dot at the start and its change: the rate at the end.
                    if (any_above(rate2, fast2())) mark(g.first_base, lane, rate2, flags);
                    sizes = sizes + (angle2 + rate2);
                    if (any_above(angle2, all(about_half_turn2)))
                        turn_back(y1, flags, constants(row, lane).real(constant::mass));
                }
                if (rows.fork_of_row[row] < 0) continue;
                Records<T, accelerated::count> forks;
                for (int k = accelerated::count; k < forks.quantities; ++k) forks.rows().set(k, W{});
                forks.rows().set(accelerated::alpha, alpha);
                forks.rows().set(accelerated::a, a);
                forks.scatter(
                    &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)], 0,
                    [&](std::uint32_t joint, int k, W w) {
                        write(rows.accelerated_records + joint * record(accelerated::count, L) + std::size_t(k), w);
                    });
            }
            if (!(total(sizes) < still_finite2)) flags.finite = false; // NaN if any is
        }
    }
};

template <class T, bool wind, bool gravity>
void outward_sweep(const CoupledRows<T>& rows, const Block& block, T* scratch, SweepFlags& flags) {
    const FlushToZero flush;
    Sweep<T>(rows).template block_out<wind, gravity>(block, scratch, flags);
}
template <class T, bool wind, bool gravity>
void inward_sweep(const CoupledRows<T>& rows, const Block& block, const T* scratch) {
    const FlushToZero flush;
    Sweep<T>(rows).template block_in<wind, gravity>(block, scratch);
}
template <class T> void accelerate_sweep(const CoupledRows<T>& rows, const Block& block, SweepFlags& flags) {
    const FlushToZero flush;
    const Sweep<T> sweep(rows);
    const bool stream = rows.stream && rows.ends && !rows.adds;
    for (std::uint32_t k = block.first_group; k < block.end_group; ++k)
        if (stream)
            sweep.template group_accelerate<true>(rows.groups[k], flags);
        else
            sweep.template group_accelerate<false>(rows.groups[k], flags);
}

} // namespace

template <class T> CoupledSweeps<T> coupled_sweeps(bool wind, bool gravity) {
    if (wind)
        return gravity
                   ? CoupledSweeps<T>{outward_sweep<T, true, true>, inward_sweep<T, true, true>, accelerate_sweep<T>}
                   : CoupledSweeps<T>{outward_sweep<T, true, false>, inward_sweep<T, true, false>, accelerate_sweep<T>};
    return gravity
               ? CoupledSweeps<T>{outward_sweep<T, false, true>, inward_sweep<T, false, true>, accelerate_sweep<T>}
               : CoupledSweeps<T>{outward_sweep<T, false, false>, inward_sweep<T, false, false>, accelerate_sweep<T>};
}

template CoupledSweeps<float> coupled_sweeps(bool, bool);
template CoupledSweeps<double> coupled_sweeps(bool, bool);

} // namespace BOUGH_TARGET
} // namespace bough::fast
