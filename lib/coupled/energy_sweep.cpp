// Compiled once for each target (CMakeLists.txt), with BOUGH_TARGET its name.
#include "energy_sweep.h"
#include "coupled_parts.h"
#include "frame_over_ground.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {
namespace {

template <class T, bool field = false> struct EnergySweep : CoupledParts<T> {
    using Parts = CoupledParts<T>;
    using Parts::constants;
    using Parts::L;
    using Parts::next;
    using Parts::now;
    using Parts::rows;
    using Parts::vector;
    using typename Parts::W;

    const EnergyRows<T>& out;

    EnergySweep(const CoupledRows<T>& r, const EnergyRows<T>& e) : Parts(r), out(e) {}

    struct Moving { // of a body: its joint's, and that joint's velocity
        M3<W> R;
        V3<W> x, omega, v;
    };
    struct Frame : FrameOverGround<W, field> {
        Moving start, end; // end's velocities: by slow joints
        V3<W> fast_omega, fast_v;
        M3<W> R; // at y*
        W y;
        V3<W> omega, v, turn;
    };
    struct Sums {
        W quantity[energy::sums] = {};
    };

    static Frame read_frame(Records<T, energy::count>& r) {
        const Rows<T> q = r.rows();
        const auto moving_at = [&](int k) {
            return Moving{q.matrix(k), q.vector(k + 9), q.vector(k + 12), q.vector(k + 15)};
        };
        FrameOverGround<W, field> over;
        if constexpr (field) over = {q.real(energy::x), q.real(energy::z)};
        return {over,
                moving_at(energy::start),
                moving_at(energy::end),
                q.vector(energy::fast_omega),
                q.vector(energy::fast_v),
                q.matrix(energy::R),
                q.real(energy::y),
                q.vector(energy::omega),
                q.vector(energy::v),
                q.vector(energy::turn)};
    }
    static void write_frame(Records<T, energy::count>& r, const Frame& f) {
        const Rows<T> q = r.rows();
        const auto put = [&](int k, const Moving& p) {
            q.set(k, p.R);
            q.set(k + 9, p.x);
            q.set(k + 12, p.omega);
            q.set(k + 15, p.v);
        };
        put(energy::start, f.start);
        put(energy::end, f.end);
        q.set(energy::fast_omega, f.fast_omega);
        q.set(energy::fast_v, f.fast_v);
        q.set(energy::R, f.R);
        q.set(energy::y, f.y);
        q.set(energy::omega, f.omega);
        q.set(energy::v, f.v);
        q.set(energy::turn, f.turn);
        if constexpr (field) {
            q.set(energy::x, f.x);
            q.set(energy::z, f.z);
        }
    }

    struct Body {
        W mass;
        V3<W> com, K;
        Symmetric<W> inertia;
    };
    // The bilinear form of the kinetic energy (energy_guard.cpp); c: centre of mass from the joint.
    BOUGH_FORCE static W kinetic(const Body& b, const M3<W>& R, const V3<W>& c, const V3<W>& v1, const V3<W>& w1,
                                 const V3<W>& v2, const V3<W>& w2) {
        const W moment = T(0.5) * (dot(v1, cross(w2, c)) + dot(v2, cross(w1, c)));
        return b.mass * (T(0.5) * dot(v1, v2) + moment) +
               T(0.5) * dot(transposed_times(R, w1), b.inertia * transposed_times(R, w2));
    }
    BOUGH_FORCE static W elastic(const Body& b, const V3<W>& theta) {
        return T(0.5) * (b.K.x * theta.x * theta.x + b.K.y * theta.y * theta.y + b.K.z * theta.z * theta.z);
    }

    // The body's place from its parent's; returns the joint's own angular velocity, which is not yet in omega.
    BOUGH_FORCE static V3<W> move(Moving& p, const M3<W>& R_pj, const V3<W>& d, const V3<W>& theta, const V3<W>& eta,
                                  V3<W>& arm) {
        const WideMaps<T> maps = wide_maps<T>(theta);
        const M3<W> G = p.R * R_pj;
        arm = p.R * d;
        p.x = p.x + arm;
        p.v = p.v + cross(p.omega, arm);
        p.R = G * maps.R();
        return G * (maps.J() * eta);
    }

    [[gnu::noinline]] void book_pulls(std::uint32_t row, int lane, const Frame& f, W& gained) const {
        for (auto k = std::size_t(rows.pull_of_row[row]); k < rows.pull_count && rows.pulls[k].row == row; ++k) {
            const PullOnLane<T>& pull = rows.pulls[k];
            const int l = int(pull.lane) - lane;
            if (l < 0 || l >= width<T>) continue;
            const auto point = [&](const Moving& p) {
                return V3<T>{
                    p.x.x[l] + pull.point[0] * p.R.x.x[l] + pull.point[1] * p.R.y.x[l] + pull.point[2] * p.R.z.x[l],
                    p.x.y[l] + pull.point[0] * p.R.x.y[l] + pull.point[1] * p.R.y.y[l] + pull.point[2] * p.R.z.y[l],
                    p.x.z[l] + pull.point[0] * p.R.x.z[l] + pull.point[1] * p.R.y.z[l] + pull.point[2] * p.R.z.z[l]};
            };
            gained[l] -= dot(V3<T>{pull.force[0], pull.force[1], pull.force[2]}, point(f.end) - point(f.start));
        }
    }

    [[gnu::noinline]] V3<W> pushes_on(std::uint32_t row, int lane) const {
        V3<W> sum{};
        for (auto k = std::size_t(rows.pull_of_row[row]); k < rows.pull_count && rows.pulls[k].row == row; ++k) {
            const int l = int(rows.pulls[k].lane) - lane;
            if (l < 0 || l >= width<T>) continue;
            sum.x[l] += rows.pulls[k].force[0];
            sum.y[l] += rows.pulls[k].force[1];
            sum.z[l] += rows.pulls[k].force[2];
        }
        return sum;
    }

    struct OnGround {
        V3<W> carried, a;
    };

    template <bool wind, Kind kind>
    BOUGH_FORCE void step(Frame& f, Sums& sums, const OnGround& ground, std::uint32_t row, int lane,
                          Folds<T> folds) const {
        const Rows<const T> k = constants(row, lane), y0 = now(row, lane);
        const Rows<T> y1 = next(row, lane);
        const T *const next_row = constants(row + 1, lane).at, *const next_start = now(row + 1, lane).at,
                       *const next_end = next(row + 1, lane).at;
        const Body b{k.real(constant::mass), k.vector(constant::com), k.vector(constant::K),
                     k.symmetric(constant::inertia_joint)};
        const M3<W> R_pj = this->joint_rotation(k);
        const V3<W> d = k.vector(constant::joint_position);
        const V3<W> theta_0 = y0.vector(motion::theta), eta_0 = y0.vector(motion::theta_dot);
        V3<W> arm;
        prefetch<0, wind ? 4 : 6>(next_start);

        // At y* (midpoint.h)
        V3<W> rate_at_com{}, air_velocity{};
        if constexpr (wind) {
            const M3<W> G = f.R * R_pj;
            V3<W> half, half_rate;
            this->halfway(y0, G, f.turn, half, half_rate);
            prefetch<4, 8>(next_start);
            const WideMaps<T> maps = wide_maps<T>(theta_0 + half);
            prefetch<8, 12>(next_start);
            const M3<W> GJ = G * maps.J();
            const V3<W> r = f.R * d;
            f.R = G * maps.R();
            f.v = f.v + cross(f.omega, r);
            f.omega = f.omega + GJ * (eta_0 + half_rate);
            f.turn = f.turn + GJ * half;
            f.y = f.y + r.y;
            const V3<W> c = f.R * b.com;
            rate_at_com = f.v + cross(f.omega, c);
            if constexpr (field) {
                f.x = f.x + r.x;
                f.z = f.z + r.z;
                const auto on = this->wind_on(row, lane, f.x + c.x, f.y + c.y, f.z + c.z);
                air_velocity = on.factor * this->field_at(on.over, rows.field.middle);
            } else {
                air_velocity = this->wind_on(f.y + c.y).factor * vector(rows.wind);
            }
        }

        prefetch<0, 4>(next_row);
        constexpr bool wood = kind == Kind::branch;
        const M3<W> host_0 = f.start.R, host_1 = f.end.R;
        const V3<W> spin_0 = move(f.start, R_pj, d, theta_0, eta_0, arm);
        const V3<W> c_0 = f.start.R * b.com, host_omega = f.start.omega;
        const V3<W> carried_0 = f.start.v + cross(host_omega, c_0); // of the centre of mass, were the joint fixed
        f.start.omega = f.start.omega + spin_0;
        prefetch<4, 8>(next_row);
        sums.quantity[energy::kinetic] +=
            kinetic(b, f.start.R, c_0, f.start.v, f.start.omega, f.start.v, f.start.omega);

        prefetch<8, 12>(next_row);
        const V3<W> theta_1 = y1.vector(motion::theta);
        const V3<W> spin_1 = move(f.end, R_pj, d, theta_1, y1.vector(motion::theta_dot), arm);
        f.fast_v = f.fast_v + cross(f.fast_omega, arm);
        const V3<W> host_omega_1 = f.end.omega + f.fast_omega, omega = host_omega_1 + spin_1;
        prefetch<12, 16>(next_row);
        const V3<W> c_1 = f.end.R * b.com;
        prefetch<0, 3>(next_end);
        if constexpr (wood) {
            const W fast = where_above(W((rows.h * rows.h) * dot(omega, omega)), all(T(watched_turn) * T(watched_turn)),
                                       all(T(1)));
            f.fast_omega = f.fast_omega + fast * spin_1;
            f.end.omega = f.end.omega + W(1 - fast) * spin_1;
            write(out.fast + row * std::size_t(L) + std::size_t(lane), fast);
        }

        prefetch<3, 6>(next_end);
        const V3<W> own = f.end.x + c_1 - (f.start.x + c_0); // as seen from the ground
        const V3<W> g = vector(rows.gravity) - ground.a;
        const V3<W> borne = host_1 * transposed_times(host_0, c_0); // c_0, were the joint fixed
        const V3<W> seen = wood ? own : c_1 - borne;                // from what carries it
        const W stored = elastic(b, theta_1) - elastic(b, theta_0);
        V3<W> force{};
        W work{}, work_seen{};
        if constexpr (wind) { // air_work of energy_guard.cpp
            const W scale = k.real(constant::drag_area);
            const V3<W> mean = (1 / rows.h) * (own + ground.carried), ahead = mean - rate_at_com;
            Symmetric<W> unused{};
            const V3<W> u = air_velocity - rate_at_com;
            const W facing = this->template facing<kind>(row, lane);
            force = air_on<kind>(u, air_speed<kind>(u, f.R), -ahead, f.R, scale, unused, W{}, folds, facing).force;
            const LeafBody<W> body{b.mass, scale};
            if constexpr (kind == Kind::leaf)
                if (rows.leaf.on)
                    force = force + leaf_force(rows.leaf, body, f.R, u, -ahead, leaf_damping(rows.leaf, body, f.R, u));
            // On a body that moved by `way` as seen from what carries it.
            const auto work_along = [&](const V3<W>& way) {
                const V3<W> U = air_velocity - (1 / rows.h) * (own + ground.carried - way);
                const W speed2 = dot(U, U);
                const V3<W> relative = air_velocity - mean;
                W limit = air_work_bound<kind>(rows.h, scale, speed2, relative, facing);
                if constexpr (kind == Kind::leaf)
                    if (rows.leaf.on) limit = limit + leaf_work(rows.leaf, body, rows.h, speed2, relative);
                return smaller(dot(force, way), limit);
            };
            work = work_along(own);
            if constexpr (!wood) work_seen = work_along(seen);
        }
        prefetch<16, constant::carried_moment>(next_row);
        const bool pulled = rows.pulls && rows.pull_of_row[row] >= 0;
        W gained = stored - b.mass * dot(g, own) - work;
        if (pulled) book_pulls(row, lane, f, gained);
        if constexpr (!wood) {
            V3<W> push{};
            if (pulled) push = pushes_on(row, lane);
            const V3<W> host_v = f.end.v + f.fast_v;
            const V3<W> a = (1 / rows.h) * (host_v + cross(host_omega_1, borne) - carried_0);
            const V3<W> rate_0 = transposed_times(f.start.R, spin_0), rate_1 = transposed_times(f.end.R, spin_1);
            const V3<W> turned = transposed_times(f.end.R, host_omega_1 - host_omega);
            const V3<W> euler = b.inertia * turned - b.mass * (dot(b.com, b.com) * turned - dot(b.com, turned) * b.com);
            const W after = T(0.5) * dot(rate_1, b.inertia * rate_1), before = T(0.5) * dot(rate_0, b.inertia * rate_0);
            const W excess = after - before + stored - work_seen - b.mass * dot(g - a, seen) + dot(euler, rate_1);
            const W most = all(T(watched_end_turn) * T(watched_end_turn));
            W left = larger(W(1 - excess / larger(after, all(T(1e-30)))), W{}); // of its energy
            left = choose_above(excess, W(T(1e-3) * after), left, all(T(1)));
            left = choose_above(W((rows.h * rows.h) * dot(omega, omega)), most, left, all(T(1)));
            left = choose_above(dot(push, push), W{}, all(T(1)), left);
            const W keep = root(left);
            write(out.fast + row * std::size_t(L) + std::size_t(lane), keep);
            f.end.omega = f.end.omega + keep * spin_1; // in the tree's balance with what it keeps
        }
        if constexpr (wind) prefetch<constant::drag_area, constant::carried_drag>(next_row);
        sums.quantity[energy::gained] += gained;
        sums.quantity[energy::slow] += kinetic(b, f.end.R, c_1, f.end.v, f.end.omega, f.end.v, f.end.omega);
        sums.quantity[energy::mixed] += kinetic(b, f.end.R, c_1, f.end.v, f.end.omega, f.fast_v, f.fast_omega);
        sums.quantity[energy::fast] += kinetic(b, f.end.R, c_1, f.fast_v, f.fast_omega, f.fast_v, f.fast_omega);
    }

    template <bool wind, Kind kind> void group(const Group& g) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, energy::count> base;
            base.gather(out.records, &rows.base[g.first_base + std::size_t(lane)]);
            Frame f = read_frame(base);
            OnGround ground{};
            if (out.ground) {
                const Rows<const T> at{out.ground + g.first_base * std::size_t(6) + lane};
                ground = {at.vector(0), at.vector(3)};
            }
            Sums sums;
            for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                step<wind, kind>(f, sums, ground, row, lane, folds_of<T>(g.kind));
                if (rows.fork_of_row[row] < 0) continue;
                write_frame(base, f);
                base.template scatter<false>(out.records,
                                             &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)], 0);
            }
            for (int k = 0; k < energy::sums; ++k)
                write(out.sums + g.first_base * std::size_t(energy::sums) + std::size_t(k * L + lane),
                      sums.quantity[k]);
        }
    }
};

template <class T, bool wind, bool field = false>
void energy_block(const CoupledRows<T>& rows, const EnergyRows<T>& energies, const Block& block) {
    const FlushToZero flush;
    const EnergySweep<T, field> sweep(rows, energies);
    for (std::uint32_t k = block.first_group; k < block.end_group; ++k) {
        const Group& g = rows.groups[k];
        if (!wind || g.kind == Kind::branch)
            sweep.template group<wind, Kind::branch>(g);
        else if (stands_for_many(g.kind) && rows.facing)
            sweep.template group<wind, Kind::clump>(g);
        else if (!is_flat(g.kind))
            sweep.template group<wind, Kind::fruit>(g);
        else
            sweep.template group<wind, Kind::leaf>(g);
    }
}

} // namespace

template <class T> EnergySweepOf<T> energy_sweep(SweepLoads loads) {
    if (loads.field) return energy_block<T, true, true>;
    return loads.wind ? energy_block<T, true> : energy_block<T, false>;
}

template EnergySweepOf<float> energy_sweep<float>(SweepLoads);
template EnergySweepOf<double> energy_sweep<double>(SweepLoads);

} // namespace BOUGH_TARGET
} // namespace bough::fast
