// analytic_chains.h: the analytic step's way over a block's chains of lanes, except what a joint does (analytic_joints.h). Outward it finds where the
// bodies are and what loads them (state_update.h, external_forces.h), inward the composites (composite.h). Everything of a body is in its own axes.
// These stages are written a second time because a row goes through them in one visit, in registers, and in axes that need no turning into the
// world's (analytic_rows.h). tests/lib/analytic/lanes.cpp holds the two together.
//
// Own is the derived sweep. It has joint_rate(row, lane, theta, turn), the joint's rate in the axes of its body; joint_loaded(row, lane), called as
// soon as the composite of the register's bodies is there, outermost first; and joints_done(), called at the end of each visit to a block.
#pragma once
#include "../lanes/sweep_parts.h"
#include "analytic_rows.h"
#include "wide_turn.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

namespace analytic_step {
namespace motion = analytic::motion;
namespace constant = analytic::constant;
namespace loaded = analytic::loaded;
namespace outward = analytic::outward;
namespace inward = analytic::inward;

template <class T, bool wind, bool pulls, bool gravity, bool field, class Own>
struct AnalyticChains : SweepParts<T, AnalyticRows<T>> {
    using Base = SweepParts<T, AnalyticRows<T>>;
    using Base::L;
    using Base::rows;
    using Base::vector;
    using typename Base::W;

    static constexpr bool forces = wind || pulls;
    static constexpr bool placed = forces || gravity; // something of the world's is felt
    static constexpr int constant_count = analytic::constants(wind), inward_count = analytic::inward_count(wind, pulls),
                         outward_count = analytic::outward_count(field);

    const Block& block;
    T* scratch;
    SweepFlags& flags;

    AnalyticChains(const AnalyticRows<T>& r, const Block& b, T* s, SweepFlags& f)
        : Base(r), block(b), scratch(s), flags(f) {}
    const Own& own() const { return static_cast<const Own&>(*this); }
    Own& own() { return static_cast<Own&>(*this); }

    const T* constants_at(std::uint32_t row, int lane) const {
        return rows.constants + this->constants_row(row) * std::size_t(constant_count) * L + lane;
    }
    T* motion_at(std::uint32_t row, int lane) const {
        return rows.motion + row * std::size_t(motion::count) * L + lane;
    }
    T* loaded_at(std::uint32_t row, int lane) const {
        return scratch + (row - block.first_row) * std::size_t(loaded::count) * L + lane;
    }
    Rows<const T> constants_of(std::uint32_t row, int lane) const { return {constants_at(row, lane)}; }
    Rows<T> loaded_of(std::uint32_t row, int lane) const { return {loaded_at(row, lane)}; }

    // ---- outward

    struct Frame {
        M3<W> R_bw;
        V3<W> omega, v; // v of the joint
        W y;
        W x{}, z{}; // with a field alone
    };

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

    Rows<T> leaf_torque_of(std::uint32_t row, int lane) const {
        const std::size_t loads = (block.end_row - block.first_row) * std::size_t(loaded::count);
        return {scratch + (loads + (row - block.first_row) * std::size_t(analytic::leaf_torque_count)) * L + lane};
    }

    // Adds the spin of parted_air.h to what is loaded.
    BOUGH_FORCE void damp_spin(const Rows<const T>& k, std::uint32_t row, int lane, const W& rate,
                               const V3<W>& omega) const {
        const Rows<T> out = loaded_of(row, lane);
        const W mass = k.real(constant::mass);
        const V3<W> c = k.vector(constant::com);
        const Symmetric<W> spin = spin_damping(rate, mass, k.symmetric(constant::inertia_joint), c);
        leaf_torque_of(row, lane).set(0, -(spin * omega));
        const W per_arm = 1 / larger(k.real(constant::com_distance), all(T(1e-9)));
        const W bound = mass * rate * (1 - dot(c, c) * (per_arm * per_arm));
        out.set(loaded::drag, W(out.real(loaded::drag) + k.real(constant::sway) * bound));
    }

    // Adds a leaf's share of parted_air.h to what is loaded.
    [[gnu::noinline]] void add_leaf(std::uint32_t row, int lane, V3<W> still, V3<W> moving) const {
        const Rows<const T> k = constants_of(row, lane);
        const Rows<T> out = loaded_of(row, lane);
        const V3<W> c = k.vector(constant::com);
        const W per_arm = 1 / larger(k.real(constant::com_distance), all(T(1e-9)));
        const PartedLeaf<W> leaf = parted_leaf(
            rows.leaf, LeafBody<W>{k.real(constant::mass), k.real(constant::drag_area)}, per_arm, still, moving);
        out.set(loaded::f, out.vector(loaded::f) + leaf.force);
        out.set(loaded::tau, out.vector(loaded::tau) + cross(c, leaf.force) + leaf.at_rest);
        out.set(loaded::drag_f, out.vector(loaded::drag_f) - leaf.taken);
        const Rows<T> torque = leaf_torque_of(row, lane);
        torque.set(0, torque.vector(0) + leaf.in_motion - leaf.at_rest);
        const W sway = k.real(constant::sway);
        out.set(loaded::drag, W(out.real(loaded::drag) + sway * leaf.drag));
        out.set(loaded::wind, W(out.real(loaded::wind) + sway * leaf.wind));
        out.set(loaded::turn, W(out.real(loaded::turn) + leaf.turn));
    }

    // On the body at rest, in its axes.
    BOUGH_FORCE V3<W> wind_at_rest(const Frame& f, std::uint32_t row, int lane, const V3<W>& c) const {
        const W y = f.y + dot(f.R_bw.y, c);
        if constexpr (field) {
            const auto on = this->wind_on(row, lane, f.x + dot(f.R_bw.x, c), y, f.z + dot(f.R_bw.z, c));
            return on.factor * (f.R_bw * this->field_at(on.over, rows.field.middle));
        } else {
            return this->wind_on(y).factor * (f.R_bw * vector(rows.wind));
        }
    }

    template <Kind kind> BOUGH_FORCE void step_out(Frame& f, std::uint32_t row, int lane, Folds<T> folds) const {
        const Rows<const T> k = constants_of(row, lane), y0{motion_at(row, lane)};
        const Rows<T> out = loaded_of(row, lane);
        const T *const next_row = constants_at(row + 1, lane), *const next_motion = y0.at + motion::count * L;
        constexpr int most = constant_count;
        const V3<W> theta = y0.vector(motion::theta);
        const W q = dot(theta, theta);
        prefetch<0, motion::count>(next_motion);
        const Turn<W> turn = turn_of(q);
        prefetch<0, most / 6>(next_row);
        const M3<W> R = this->joint_rotation(k) * turn_form(theta, q, turn.s, turn.c1);
        prefetch<most / 6, most / 3>(next_row);
        out.set(loaded::R_pb, R);
        prefetch<most / 3, placed ? most / 2 : most>(next_row);
        if constexpr (!placed) return;
        const V3<W> r = k.vector(constant::joint_position);
        if constexpr (wind) {
            f.y = f.y + dot(f.R_bw.y, r);
            if constexpr (field) {
                f.x = f.x + dot(f.R_bw.x, r);
                f.z = f.z + dot(f.R_bw.z, r);
            }
            f.v = transposed_times(R, f.v + cross(f.omega, r));
            f.omega = transposed_times(R, f.omega) + own().joint_rate(row, lane, theta, turn);
        }
        f.R_bw = {transposed_times(R, f.R_bw.x), transposed_times(R, f.R_bw.y), transposed_times(R, f.R_bw.z)};
        prefetch<most / 2, wind ? 2 * most / 3 : most>(next_row);
        if constexpr (gravity) out.set(loaded::g, f.R_bw * vector(rows.gravity));
        if constexpr (wind) {
            const V3<W> c = k.vector(constant::com);
            const V3<W> still = wind_at_rest(f, row, lane, c), moving = still - f.v - cross(f.omega, c);
            const W scale = k.real(constant::drag_area);
            const W still2 = dot(still, still), still_speed = root(still2);
            W speed_0, speed_1;
            const W facing = this->template facing<kind>(row, lane);
            const V3<W> f0 = air_in_body_axes<kind>(still, speed_0, folds, facing, f.R_bw.y),
                        f1 = air_in_body_axes<kind>(moving, speed_1, folds, facing, f.R_bw.y);
            prefetch<2 * most / 3, 5 * most / 6>(next_row);
            const V3<W> force = scale * f0;
            out.set(loaded::f, force);
            out.set(loaded::tau, cross(c, force));
            out.set(loaded::drag_f, scale * (f1 - f0));
            prefetch<5 * most / 6, most>(next_row);
            W largest = scale; // [kg/m] of any direction
            if constexpr (kind == Kind::clump) largest = (1 + facing) * scale;
            const W sway = largest * k.real(constant::sway);
            out.set(loaded::drag, W(sway * (speed_1 + speed_0)));
            const W pressing = kind == Kind::branch ? still_speed : speed_0;
            out.set(loaded::wind, W(sway * pressing));
            constexpr T turns = kind == Kind::branch ? T(3) : kind == Kind::leaf ? T(2) : T(1);
            out.set(loaded::turn, W(turns * largest * pressing * still_speed));
            if constexpr (kind != Kind::branch)
                if (folds.fold > 0) {
                    W rate = spin_rate<kind>(scale, k.real(constant::mass), speed_1);
                    if (kind == Kind::leaf && rows.leaf.on) rate = rate + leaf_spin(rows.leaf);
                    damp_spin(k, row, lane, rate, f.omega);
                }
            if constexpr (kind == Kind::leaf)
                if (rows.leaf.on) add_leaf(row, lane, still, moving);
        } else if constexpr (pulls) {
            for (int j = 0; j < 6; ++j) out.set(loaded::f + j, W{});
        }
        if constexpr (forces)
            if (rows.pulls && rows.pull_of_row[row] >= 0) add_pulls(row, lane, f.R_bw, out);
    }

    template <Kind kind> void group_out(const Group& g) const {
        for (int lane = 0; lane < L; lane += width<T>) {
            Records<T, outward_count> base;
            Frame f{};
            const Rows<T> q = base.rows();
            if constexpr (placed) {
                base.gather(rows.outward_records, &rows.base[g.first_base + std::size_t(lane)]);
                f = {q.matrix(outward::R_bw), q.vector(outward::omega), q.vector(outward::v), q.real(outward::y)};
                if constexpr (field) {
                    f.x = q.real(outward::x);
                    f.z = q.real(outward::z);
                }
            }
            for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                step_out<kind>(f, row, lane, folds_of<T>(g.kind));
                if (!placed || rows.fork_of_row[row] < 0) continue;
                q.set(outward::R_bw, f.R_bw);
                q.set(outward::omega, f.omega);
                q.set(outward::v, f.v);
                q.set(outward::y, f.y);
                if constexpr (field) {
                    q.set(outward::x, f.x);
                    q.set(outward::z, f.z);
                }
                base.template scatter<false>(rows.outward_records,
                                             &rows.fork[std::size_t(rows.fork_of_row[row]) * L + std::size_t(lane)], 0);
            }
        }
    }

    // ---- inward

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
                if constexpr (wind)
                    if (is_foliage(g.kind)) q.drag_tau = q.drag_tau + leaf_torque_of(row, lane).vector(0);
                step_in(q, row, lane);
                own().joint_loaded(row, lane);
            }
            Records<T, inward_count> base;
            keep(q, base.rows());
            for (int k = inward_count; k < base.quantities; ++k) base.rows().set(k, W{});
            base.template scatter<true>(rows.inward_records, &rows.landing[g.first_base + std::size_t(lane)], nothing);
        }
    }

    // ---- a block

    void out() {
        T* forks = rows.inward_records + block.first_fork * record(inward_count, L);
        std::memset(forks, 0, (block.end_fork - block.first_fork) * record(inward_count, L) * sizeof(T));
        for (std::uint32_t k = block.first_group; k < block.end_group; ++k) {
            const Group& g = rows.groups[k];
            if (!wind || g.kind == Kind::branch)
                group_out<Kind::branch>(g);
            else if constexpr (wind) {
                if (stands_for_many(g.kind) && rows.facing)
                    group_out<Kind::clump>(g);
                else if (!is_flat(g.kind))
                    group_out<Kind::fruit>(g);
                else
                    group_out<Kind::leaf>(g);
            }
            if (k >= block.terminal_group) group_in(g);
        }
        own().joints_done();
    }
    void in() {
        for (std::uint32_t k = block.terminal_group; k-- > block.first_group;) group_in(rows.groups[k]);
        own().joints_done();
    }
};

} // namespace analytic_step
} // namespace BOUGH_TARGET
} // namespace bough::fast
