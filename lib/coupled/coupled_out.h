// coupled_out.h: the coupled step's first sweep outward over lanes (coupled_sweeps.h): where each body is half a step on (midpoint.h), and its load
// there (body_load.h, the joint's own spring and damper).
//
// It is written a second time because a row goes through both stages in one visit, in registers, and what its kind and the scene lack is compiled
// out; the plain stages each go over all bodies' arrays. tests/lib/coupled/lanes.cpp holds the two together.
// Reads   constants, now, records outward of the joints that chains begin on, the wind's profile, pulls
// Writes  loaded; of solved rates and r, which then wait no longer in the cache than the row takes; records outward of forks
// Cost    about 760 arithmetic instructions a row (AVX-512, gusty wind) among 1600. Errors none; what turns fast is counted and marked.
#pragma once
#include "coupled_parts.h"
#include <algorithm>

namespace bough::fast {
inline namespace BOUGH_TARGET {

// field: with a wind that varies over the ground (WindField).
template <class T, bool field = false> struct CoupledOut : CoupledParts<T> {
    using Parts = CoupledParts<T>;
    using Parts::constants;
    using Parts::fast2;
    using Parts::L;
    using Parts::mark;
    using Parts::now;
    using Parts::Parts;
    using Parts::rows;
    using Parts::solved_row;
    using Parts::vector;
    using typename Parts::C;
    using typename Parts::W;

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

    // What the pulls ask for. It is returned by value: what a function gets a reference to cannot stay in registers.
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

    // The wind where the profile is 1, and its change over the step.
    BOUGH_FORCE V3<W> wind_here(const typename Parts::WindOn& on) const {
        if constexpr (field)
            return this->field_at(on.over, rows.field.middle);
        else
            return vector(rows.wind);
    }
    BOUGH_FORCE V3<W> wind_change_here(const typename Parts::WindOn& on) const {
        if constexpr (field)
            return this->field_at(on.over, rows.field_end) - this->field_at(on.over, rows.field_start);
        else
            return vector(rows.wind_change);
    }

    struct LeafIn {
        M3<W> R;
        V3<W> u, ahead, change; // [m/s] past the centre of mass; its velocity ahead; the wind's over the step
        V3<W> turn, own;
    };
    // Adds what the air takes of a body's own turning to what is loaded. It is damping, and the sweep inward has no damping in turning. As s1 = 1/s
    // and s2 = s1^2 are complex, s1 = x + y s2 with the reals x = |s1|^2 / (2 Re s1), y = 1 / (2 Re s1); so it goes to J and H in these parts.
    BOUGH_FORCE void damp_spin(const Rows<T>& out, const W& rate, const W& mass, const V3<W>& c, const V3<W>& omega_0,
                               Symmetric<W>& J, Symmetric<W>& H, V3<C>& N) const {
        const Symmetric<W> G = spin_damping(rate, mass, J, c);
        const V3<W> taken = G * omega_0;
        N = N + complex(taken, V3<W>{});
        const T y = 1 / (2 * rows.s1[0]), x = (rows.s1[0] * rows.s1[0] + rows.s1[1] * rows.s1[1]) * y;
        J = J + x * G;
        H = H + y * G;
        out.set(loaded::J, J);
    }
    // Adds leaf_air.h, without nu I w, to what is loaded.
    [[gnu::noinline]] void add_leaf(const Rows<const T>& k, const Rows<T>& out, LeafIn in) const {
        const LeafTerms<T>& terms = rows.leaf;
        const LeafBody<W> body{k.real(constant::mass), k.real(constant::drag_area)};
        const V3<W> com = k.vector(constant::com), c = out.vector(loaded::c);
        const Symmetric<W> D = leaf_damping(terms, body, in.R, in.u);
        const Symmetric<W> H = leaf_turning(terms, body, root(dot(com, com)), in.R, in.u);
        const V3<W> slope = D * in.change, f = leaf_force(terms, body, in.R, in.u, in.ahead, D) + rows.slope[0] * slope,
                    fi = rows.slope[1] * slope;
        const V3<W> bent_by = in.turn - rows.s1[0] * in.own;
        const V3<W> N = -leaf_torque(terms, body, in.R.y, in.u) - cross(c, f) - H * bent_by,
                    Ni = rows.s1[1] * (H * in.own) - cross(c, fi);
        out.set(loaded::N, out.complex_vector(loaded::N) + complex(N, Ni));
        out.set(loaded::F, out.complex_vector(loaded::F) + complex(-f, -fi));
        out.set(loaded::D, out.symmetric(loaded::D) + D);
        out.set(loaded::H, out.symmetric(loaded::H) + H);
    }

    // Takes one row: finds the frame of its bodies from their parents'. f: the quantities of `outward`. Both f and what is loaded stay in memory,
    // from which each part reads what it needs (coupled_in.h, step_in).
    template <bool wind, bool gravity, Kind kind>
    BOUGH_FORCE void step_out(const Rows<T>& f, std::uint32_t row, std::uint32_t row_base, int lane, const Rows<T>& out,
                              W& fastest, SweepFlags& flags, Folds<T> folds) const {
        const Rows<const T> k = constants(row, lane), y0 = now(row, lane);
        const T *const next_row = constants(row + 1, lane).at, *const next_motion = now(row + 1, lane).at;
        const T h = rows.h;
        const W mass = k.real(constant::mass);

        V3<W> w_0, w_ahead, psi, bias; // of the joint, and beside them what has gone to memory
        {
            const V3<W> theta_0 = y0.vector(motion::theta), eta_0 = y0.vector(motion::theta_dot);
            const M3<W> G = f.matrix(outward::R) * this->joint_rotation(k);
            V3<W> half, half_rate;
            this->halfway(y0, G, f.vector(outward::turn), half, half_rate);
            prefetch<0, 4>(next_motion);
            const V3<W> eta = eta_0 + half_rate;
            const WideMaps<T> maps = wide_maps<T>(V3<W>(theta_0 + half));
            prefetch<4, 8>(next_motion);
            {
                const M3<W> GJ = G * maps.J();
                w_0 = GJ * eta_0, w_ahead = GJ * half_rate, psi = GJ * half;
            }
            prefetch<8, 12>(next_motion);
            bias = G * maps.rate_bias(resolved(eta, h, mass, flags.fast_turns));
            const V3<W> r = f.matrix(outward::R) * k.vector(constant::joint_position);
            out.set(loaded::r, r);
            const M3<W> R = G * maps.R();
            f.set(outward::R, R);
            prefetch<0, 4>(next_row);
            out.set(loaded::c, R * k.vector(constant::com));
            const M3<W> rates = maps.J_inverse() * transposed(G);
            const auto keep = [&](const auto& to) {
                to.set(solved::rates, rates);
                to.set(solved::r, r);
            };
            if (rows.stream)
                keep(Rows<T, true>{solved_row(row, lane).at});
            else
                keep(solved_row(row, lane));
            prefetch<4, 8>(next_row);
            // The joint's spring and damper
            const V3<W> K = k.vector(constant::K);
            const M3<W> KT{{K.x * rates.x.x, K.y * rates.x.y, K.z * rates.x.z},
                           {K.x * rates.y.x, K.y * rates.y.y, K.z * rates.y.z},
                           {K.x * rates.z.x, K.y * rates.z.y, K.z * rates.z.z}};
            const V3<W> bent = theta_0 + W(k.real(constant::beta) + rows.s1[0]) * eta_0;
            out.set(loaded::torque, complex(-transposed_times(KT, bent), -(rows.s1[1] * transposed_times(KT, eta_0))));
            out.set(loaded::K, symmetric_transposed_product(rates, KT));
            prefetch<8, 12>(next_row);
        }
        forget_memory();
        {
            const V3<W> r = out.vector(loaded::r);
            const V3<W> omega_p = f.vector(outward::omega), alpha_p = f.vector(outward::alpha), w = w_0 + w_ahead;
            const V3<W> spin_p = resolved(omega_p, h, mass, flags.fast_turns),
                        turning = resolved(w, h, mass, flags.fast_turns);
            f.set(outward::alpha, V3<W>(alpha_p + cross(spin_p, turning) + bias));
            f.set(outward::a, V3<W>(f.vector(outward::a) + cross(alpha_p, r) + cross(spin_p, cross(spin_p, r))));
            prefetch<12, 15>(next_row);
            f.set(outward::v, V3<W>(f.vector(outward::v) + cross(omega_p, r)));
            const V3<W> ahead_p = f.vector(outward::ahead_omega);
            f.set(outward::ahead_v, V3<W>(f.vector(outward::ahead_v) + cross(ahead_p, r)));
            f.set(outward::ahead_omega, V3<W>(ahead_p + w_ahead));
            const V3<W> omega = omega_p + w;
            f.set(outward::omega, omega);
            f.set(outward::own, V3<W>(f.vector(outward::own) + w_0));
            f.set(outward::turn, V3<W>(f.vector(outward::turn) + psi));
            prefetch<15, 18>(next_row);
            const W omega2 = dot(omega, omega);
            fastest = larger(omega2, fastest);
            constexpr bool wood = kind == Kind::branch;
            if (any_above(omega2, fast2(wood))) mark(row_base, lane, omega2, wood, flags);
            if constexpr (wind) f.set(outward::y, W(f.real(outward::y) + r.y));
            if constexpr (field) {
                f.set(outward::x, W(f.real(outward::x) + r.x));
                f.set(outward::z, W(f.real(outward::z) + r.z));
            }
        }
        forget_memory();
        const V3<W> c = out.vector(loaded::c), omega = f.vector(outward::omega);
        typename Parts::WindOn wind_on{};
        V3<W> u{};
        AirSpeed<W> speed{};
        if constexpr (wind) {
            if constexpr (field)
                wind_on = this->wind_on(row, lane, f.real(outward::x) + c.x, f.real(outward::y) + c.y,
                                        f.real(outward::z) + c.z);
            else
                wind_on = this->wind_on(f.real(outward::y) + c.y);
            u = wind_on.factor * wind_here(wind_on) - f.vector(outward::v) - cross(omega, c);
            speed = air_speed<kind>(u, f.matrix(outward::R));
        }
        prefetch<18, 21>(next_row);

        // body_load.h
        std::uint64_t seen = 0; // counted at the next body's turn about it
        const V3<W> spin = resolved(omega, h, mass, seen);
        const V3<W> g = vector(rows.gravity);
        const M3<W> R = f.matrix(outward::R);
        V3<W> turning_N;
        {
            const Symmetric<W> J = turned(R, k.symmetric(constant::inertia_joint));
            out.set(loaded::J, J);
            const V3<W> alpha = f.vector(outward::alpha);
            turning_N = J * alpha + cross(spin, J * spin);
        }
        prefetch<21, 24>(next_row);
        Symmetric<W> H{};
        V3<W> a0 = f.vector(outward::a);
        if constexpr (gravity) {
            const V3<W> P = R * k.vector(constant::carried_moment);
            const W Pg = dot(P, g);
            H = {Pg - P.x * g.x, T(-0.5) * (P.x * g.y + P.y * g.x), T(-0.5) * (P.x * g.z + P.z * g.x),
                 Pg - P.y * g.y, T(-0.5) * (P.y * g.z + P.z * g.y), Pg - P.z * g.z};
            a0 = a0 - g;
        }
        const V3<W> turning_F = mass * (cross(f.vector(outward::alpha), c) + cross(spin, cross(spin, c)));
        V3<W> at_com = mass * a0, slope{}; // [N] what is to be turned about the joint: all but the body's own turning
        if constexpr (wind) {
            const V3<W> ahead = f.vector(outward::ahead_v) + cross(f.vector(outward::ahead_omega), c);
            const V3<W> com = k.vector(constant::com);
            const W arm = kind == Kind::leaf ? root(dot(com, com)) : W{};
            const AirOn<W> air = air_on<kind>(u, speed, ahead, R, k.real(constant::drag_area), H, arm, folds,
                                              this->template facing<kind>(row, lane));
            out.set(loaded::D, air.D);
            H = H + streaming_stiffness(rows.folds, V3<W>(R * k.vector(constant::carried_drag)), u,
                                        kind == Kind::branch ? root(dot(u, u)) : speed.speed);
            const V3<W> slope_F = air.D * (wind_on.factor * wind_change_here(wind_on));
            at_com = at_com - air.force - rows.slope[0] * slope_F;
            slope = -(rows.slope[1] * slope_F);
        }
        prefetch<24, constant::count>(next_row);
        V3<C> F = complex(turning_F + at_com, slope), N = complex(turning_N + cross(c, at_com), cross(c, slope));
        if constexpr (gravity || wind) {
            const V3<W> own = f.vector(outward::own);
            const V3<W> bent_by = f.vector(outward::turn) - rows.s1[0] * own, back = H * bent_by,
                        ahead_back = rows.s1[1] * (H * own);
            N = complex(V3<W>{N.x.re - back.x, N.y.re - back.y, N.z.re - back.z},
                        V3<W>{N.x.im + ahead_back.x, N.y.im + ahead_back.y, N.z.im + ahead_back.z});
        }
        if constexpr (wind && kind != Kind::branch)
            if (folds.fold > 0) {
                W rate = spin_rate<kind>(k.real(constant::drag_area), mass,
                                         W(unfolding<kind>(folds, speed.speed).share * speed.speed));
                if (kind == Kind::leaf && rows.leaf.on) rate = rate + leaf_spin(rows.leaf);
                Symmetric<W> J = out.symmetric(loaded::J);
                damp_spin(out, rate, mass, c, V3<W>(omega - f.vector(outward::ahead_omega)), J, H, N);
            }
        if constexpr (gravity || wind) out.set(loaded::H, H);
        if (rows.pulls && rows.pull_of_row[row] >= 0) {
            const Pulls pulls = pulls_on(row, lane, R);
            N = N + pulls.N;
            F = F + pulls.F;
        }
        out.set(loaded::N, N);
        out.set(loaded::F, F);
        if constexpr (wind && kind == Kind::leaf)
            if (rows.leaf.on)
                add_leaf(k, out,
                         {R, u, f.vector(outward::ahead_v) + cross(f.vector(outward::ahead_omega), c),
                          wind_on.factor * wind_change_here(wind_on), f.vector(outward::turn), f.vector(outward::own)});
    }

    template <bool wind, bool gravity, Kind kind>
    void group_out(const Group& g, T* loaded_rows, SweepFlags& flags) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, outward::count> base;
            base.gather(rows.outward_records, &rows.base[g.first_base + std::size_t(lane)]);
            const Rows<T> f = base.rows();
            W fastest{};
            for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                step_out<wind, gravity, kind>(f, row, g.first_base, lane,
                                              {loaded_rows + std::size_t(row - g.first_row) * loaded::count * L + lane},
                                              fastest, flags, folds_of<T>(g.kind));
                if (rows.fork_of_row[row] < 0) continue;
                base.template scatter<false>(rows.outward_records,
                                             &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)], 0);
            }
            for (int l = 0; l < width<T>; ++l) flags.omega2 = std::max(flags.omega2, double(fastest[l]));
        }
    }
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
