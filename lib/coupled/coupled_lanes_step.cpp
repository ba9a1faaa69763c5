#include "coupled_lanes_step.h"
#include "../base/parallel.h"
#include "../lanes/shared_constants.h"
#include "../model/air_constants.h"
#include "../model/own_inertia.h"
#include "../plan/pushes.h"
#include "attachment.h"
#include "attachment_lanes.h"
#include "coupled_tables.h"
#include "coupled_targets.h"
#include "energy_lanes.h"
#include "half_turn.h"
#include "midpoint.h"
#include "pulled_points.h"
#include "sleep.h"
#include <algorithm>

namespace bough::fast {
namespace {

using fast::put;
template <class T> void put(T (&to)[2], std::complex<double> z) {
    to[0] = T(z.real());
    to[1] = T(z.imag());
}
template <class T> void put(RowVector<T>& rows, std::size_t joint, int count, int quantity, const Vector3<T>& v) {
    for (int k = 0; k < 3; ++k) entry(rows, joint, count, quantity + k) = v[k];
}

// take_shorter_way for one body's numbers.
template <class T> bool shorten(T* theta, T* theta_dot, T* theta_change, T* theta_dot_change, T h) {
    using Map = Eigen::Map<Vector3<T>>;
    Vector3<T> t = Map(theta), rate = Map(theta_dot), change = Map(theta_change), rate_change = Map(theta_dot_change);
    if (!take_shorter_way(t, rate, change, rate_change, h)) return false;
    Map(theta, 3) = t;
    Map(theta_dot, 3) = rate;
    Map(theta_change, 3) = change;
    Map(theta_dot_change, 3) = rate_change;
    return true;
}

template <class T>
void place_grounds(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, double time,
                   std::complex<double> slope) {
    ground_over_step(plan, own, work, time);
    Lanes<T>& lanes = work.lanes;
    for (std::size_t joint = 0; joint < own.lanes.layout.grounds; ++joint) {
        Matrix3<T> R = Matrix3<T>::Identity();
        if (joint > 0) {
            const GroundStep<T>& g = work.ground[joint - 1];
            R = g.R;
            entry(lanes.outward, joint, outward::count, outward::x) = g.x.x();
            entry(lanes.outward, joint, outward::count, outward::y) = g.x.y();
            entry(lanes.outward, joint, outward::count, outward::z) = g.x.z();
            put(lanes.outward, joint, outward::count, outward::omega, g.omega);
            put(lanes.outward, joint, outward::count, outward::v, g.v);
            put(lanes.outward, joint, outward::count, outward::ahead_omega, Vector3<T>(g.omega - g.omega_0));
            put(lanes.outward, joint, outward::count, outward::ahead_v, Vector3<T>(g.v - g.v_0));
            for (int k = 0; k < 3; ++k)
                for (int part = 0; part < 2; ++part) {
                    const T weight = T(part ? slope.imag() : slope.real());
                    entry(lanes.accelerated, joint, accelerated::count, accelerated::alpha + 2 * k + part) =
                        weight * g.slope_alpha[k] + (part ? 0 : g.alpha[k]);
                    entry(lanes.accelerated, joint, accelerated::count, accelerated::a + 2 * k + part) =
                        weight * g.slope_a[k] + (part ? 0 : g.a[k]);
                }
        }
        for (int k = 0; k < 3; ++k) put(lanes.outward, joint, outward::count, outward::R + 3 * k, Vector3<T>(R.col(k)));
    }
}

// For the solve of the scheme's pole k.
template <class T>
CoupledRows<T> rows_of(const Plan<T>& plan, const CoupledLanesPlan<T>& own, State<T>& state, CoupledLanesState<T>& work,
                       double time, int k) {
    Lanes<T>& lanes = work.lanes;
    const Layout& layout = own.lanes.layout;
    const Pole pole = scheme_of(own.scheme).pole[std::size_t(k)];
    const double h = plan.dt;
    const std::complex<double> slope = 1.0 / pole.p - 0.5;
    CoupledRows<T> rows{};
    place_tables<T>(plan, own.lanes, state, work.lanes, time + h / 2, rows);
    rows.accelerated_records = data(lanes.accelerated);
    rows.watched = lanes.watched.data();
    rows.stream = own.lanes.target == Target::avx512 && streams(layout);
    rows.adds = k > 0;
    rows.ends = k + 1 == scheme_of(own.scheme).poles;
    put(rows.s1, h / pole.p);
    put(rows.s2, h / pole.p * h / pole.p);
    put(rows.slope, slope);
    // x_v = -x / p, x_u = (h x_v - eta_0) / p; the changes are h 2 Re (c x_v), h 2 Re (c x_u).
    put(rows.of_rate, -2 * h * pole.c / pole.p);
    put(rows.of_angle, -2 * h * h * pole.c / (pole.p * pole.p));
    rows.eta = T((-2 * h * pole.c / pole.p).real());
    if (plan.field)
        place_field_change(plan, work, time, rows);
    else if (plan.wind)
        put(rows.wind_change, wind_velocity(*plan.scene.wind, time + h) - wind_velocity(*plan.scene.wind, time));
    for (PullOnLane<T>& on : lanes.pulls) {
        if (on.source == no_source) continue;
        const Pull& pull = plan.scene.pulls[on.source];
        put(on.change, pull_force(pull, time + h) - pull_force(pull, time));
    }
    rows.folds = folds_of<T>(plan.foliage ? Kind::leaf : Kind::branch);
    rows.shorten = shorten<T>;
    place_grounds(plan, own, work, time, slope);
    put_attachments(plan, work, pole.p, rows);
    return rows;
}

// For the solve of the scheme's pole k.
template <class T>
SweepFlags sweep(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work,
                 const CoupledRows<T>& rows, int k) {
    const CoupledSweeps<T> sweeps = coupled_sweeps_for<T>(own.lanes.target, sweep_loads(plan));
    const std::vector<Block>& blocks = own.lanes.layout.blocks;
    Lanes<T>& lanes = work.lanes;
    const std::size_t most = largest_block(own.lanes.layout);
    // A row; the top's solutions are in the table
    constexpr std::size_t count = std::size_t(loaded::count) + solved::count;
    share_scratch(own.lanes.layout, lanes, (blocks[0].end_row - blocks[0].first_row) * std::size_t(loaded::count),
                  most * count);
    std::vector<SweepFlags>& flags = lanes.flags;
    flags.assign(blocks.size(), SweepFlags{});
    SweepFlags& top = flags[0];
    const Rest rest_of_top = rest_of(work.lanes, 0);
    T* top_scratch = data(lanes.scratch[0]);
    const auto rows_of_block = [&](const Block& block) {
        CoupledRows<T> mine = rows;
        place_block(own, work, block, mine);
        return mine;
    };
    const CoupledRows<T> top_rows = rows_of_block(blocks[0]);
    if (rest_of_top == Rest::awake) sweeps.outward(top_rows, blocks[0], top_scratch, top);
    if (rest_of_top == Rest::settling) keep_motion(own, work, blocks[0]); // not swept
    std::size_t awake = 0, wait = 0; // blocks; of them those that are solved once the top is
    for (std::size_t b = 1; b < blocks.size(); ++b)
        if (rest_of(work.lanes, b) != Rest::asleep) {
            ++awake;
            wait += !blocks[b].whole;
        }
    const double cost = block_cost(own.lanes.layout) / double(blocks.size());
    parallel_blocks(blocks.size() - 1, cost * double(awake), [&](std::size_t which, int worker) {
        const std::size_t b = 1 + which;
        const Block& block = blocks[b];
        const Rest rest = rest_of(work.lanes, b);
        if (rest == Rest::settling && block.whole) keep_motion(own, work, block);
        if (rest == Rest::asleep || (rest == Rest::settling && block.whole)) return;
        SweepFlags& met = flags[b];
        T* scratch = data(lanes.scratch[1 + std::size_t(worker)]);
        CoupledRows<T> mine = rows_of_block(block);
        if (block.whole) { // nothing to wait for: what is solved stays in the cache
            mine.solved_rows = scratch + most * std::size_t(loaded::count) * Row<T>::lanes;
            mine.solved_stride = solved::count;
            mine.stream = false;
        }
        sweeps.outward(mine, block, scratch, met);
        sweeps.inward(mine, block, scratch);
        if (block.whole) sweeps.accelerate(mine, block, met);
        if (rest == Rest::settling) keep_motion(own, work, block); // now that what is solved has gone in
    });
    if (rest_of_top == Rest::awake) {
        add_ports(own.lanes, work.lanes, inward::count);
        sweeps.inward(top_rows, blocks[0], top_scratch);
        tie_in_lanes(plan, own, work, scheme_of(own.scheme).pole[std::size_t(k)].p);
        sweeps.accelerate(top_rows, blocks[0], top);
    }
    parallel_blocks(
        blocks.size() - 1, cost * double(wait) / 5,
        [&](std::size_t which, int) {
            const std::size_t b = 1 + which;
            if (!blocks[b].whole && rest_of(work.lanes, b) == Rest::awake)
                sweeps.accelerate(rows_of_block(blocks[b]), blocks[b], flags[b]);
        },
        Order::backward); // the last are in the caches still
    SweepFlags all;
    for (const SweepFlags& f : flags) all += f;
    return all;
}

// Of the trees whose ground jumps: a motion that begins here.
template <class T> void drop_changes(const Plan<T>& plan, const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work) {
    const Layout& layout = own.lanes.layout;
    constexpr std::size_t L = Row<T>::lanes;
    const T h = T(plan.dt);
    const auto jumps = [&](std::uint32_t tree) {
        const std::uint32_t joint = tree == nothing ? 0 : layout.ground[tree];
        return joint > 0 && work.ground[joint - 1].jumps;
    };
    for (const Block& block : layout.blocks) {
        const Run next = places_of(own, work, block).next;
        for (std::uint32_t k = block.first_group; k < block.end_group; ++k) {
            const Group& g = layout.groups[k];
            for (std::size_t l = 0; l < L; ++l) {
                if (!jumps(layout.tree[g.first_base + l])) continue;
                for (std::uint32_t row = g.first_row; row < g.first_row + g.length; ++row) {
                    Row<T>* motion = &work.lanes.table[std::size_t(next.at(row - block.first_row))];
                    for (std::size_t q = 0; q < 3; ++q) {
                        motion[motion::theta_change + q].lane[l] = h * motion[motion::theta_dot + q].lane[l];
                        motion[motion::theta_dot_change + q].lane[l] = 0;
                    }
                }
            }
        }
    }
}

template <class T>
Slot<T> motion_of(RowVector<T>& table, const std::vector<std::size_t>& motion_at, std::uint32_t slot) {
    constexpr std::size_t lanes = Row<T>::lanes;
    return Slot<T>(table, 1, motion_at[slot / lanes] * lanes + slot % lanes);
}

} // namespace

template <class T>
void unpack(const Plan<T>& plan, const CoupledLanesPlan<T>& own, State<T>& state, CoupledLanesState<T>& work) {
    for (auto* array : {&state.theta, &state.theta_dot, &work.theta_change, &work.theta_dot_change})
        array->resize(plan.bodies); // where they were left out
    std::vector<std::size_t>& motion_at = work.lanes.motion_at;
    motion_of_rows(own, work, motion_at);
    parallel_for(plan.bodies, 20, [&](std::size_t i) {
        const Slot<T> row = motion_of(work.lanes.table, motion_at, own.lanes.layout.slot[i]);
        state.theta[i] = row.vector(motion::theta);
        state.theta_dot[i] = row.vector(motion::theta_dot);
        work.theta_change[i] = row.vector(motion::theta_change);
        work.theta_dot_change[i] = row.vector(motion::theta_dot_change);
    });
}

template <class T> void fill_coupled(const Plan<T>& plan, CoupledLanesPlan<T>& own) {
    fill_constants(own.lanes, constant::count, put_pad<T>, [&](std::size_t i, const Slot<T>& row) {
        put_body(plan, i, row);
        row.put(constant::inertia_joint, own_inertia(plan.inertia_joint[i]));
        if (plan.gravity) row.put(constant::carried_moment, own.carried_moment[i]);
        if (plan.wind) row.put(constant::drag_area, plan.drag_area[i]);
        if (plan.wind) row.put(constant::carried_drag, own.carried_drag[i]);
    });
}

template <class T>
void pack(const Plan<T>& plan, const CoupledLanesPlan<T>& own, State<T>& state, CoupledLanesState<T>& work,
          const std::vector<Vector3<T>>& theta) {
    const Layout& layout = own.lanes.layout;
    Lanes<T>& lanes = work.lanes;
    lanes.odd = false;
    const int columns = coupled_columns(waits(layout), scheme_of(own.scheme).poles);
    set_zero_rows(lanes.table, std::size_t(layout.rows) * std::size_t(columns)); // pads do not move
    std::vector<std::size_t>& motion_at = lanes.motion_at;
    motion_of_rows(own, work, motion_at);
    lanes.watched.assign(layout.base.size(), 0);
    if (own.lanes.sleep.on) lanes.rest.assign(layout.blocks.size(), BlockRest{});
    lanes.carried_turn = 0;
    resize_records(layout, lanes.outward, outward::count);
    resize_records(layout, lanes.inward, inward::count);
    std::fill(lanes.inward.begin(), lanes.inward.end(), Row<T>{}); // of sleepers', which are awake now
    resize_records(layout, lanes.accelerated, accelerated::count);
    parallel_for(layout.body.size(), 20, [&](std::size_t slot) {
        if (layout.body[slot] < 0) return;
        const auto i = std::size_t(layout.body[slot]);
        const Slot<T> row = motion_of(lanes.table, motion_at, std::uint32_t(slot));
        row.put(motion::theta, theta[i]);
        row.put(motion::theta_dot, entry(state.theta_dot, i));
        row.put(motion::theta_change, entry(work.theta_change, i));
        row.put(motion::theta_dot_change, entry(work.theta_dot_change, i));
    });
    pack_pulls(plan, own.lanes, work.lanes);
    lanes.presented = true;
}

template <class T>
void coupled_lanes_step(const Plan<T>& plan, const CoupledLanesPlan<T>& own, State<T>& state,
                        CoupledLanesState<T>& work, StageClock* clock) {
    const double time = time_of(plan, state);
    wake_blocks(plan, own, state, work, time);
    if (all_asleep(work.lanes)) { // what present has made stays as it is
        ++state.step;
        return;
    }
    SweepFlags flags;
    if (take_loads(plan, state, work.attachments)) place_attached_rows(own, work);
    if (work.attachments.any())
        run_stage(Stage::attachments, state, clock, [&] {
            if (plan.root_motion) ground_over_step(plan, own, work, time);
            read_attached(own, work, false);
            place_attachments(plan, own, work, time);
        });
    run_stage(Stage::lanes, state, clock, [&] {
        CoupledRows<T> rows = rows_of(plan, own, state, work, time, 0);
        flags = sweep(plan, own, work, rows, 0);
        for (int k = 1; k < scheme_of(own.scheme).poles; ++k) {
            rows = rows_of(plan, own, state, work, time, k);
            const SweepFlags solved =
                sweep(plan, own, work, rows, k); // its way outward has met with the same as the first
            flags.half_turns = solved.half_turns;
            flags.fast = solved.fast;
            flags.finite = solved.finite;
        }
        if (work.attachments.any()) {
            read_attached(own, work, true);
            settle_attachments(work.attachments);
        }
        for (const GroundStep<T>& ground : work.ground)
            if (ground.jumps) {
                drop_changes(plan, own, work);
                break;
            }
        rest_blocks(plan, own, work, work.lanes.flags);
        if (!flags.fast) return;
        guard_lanes(plan, own, state, work, rows);
        std::fill(work.lanes.watched.begin(), work.lanes.watched.end(), std::uint8_t(0));
    });
    work.lanes.odd = !work.lanes.odd;
    work.lanes.presented = false;
    work.lanes.finite = flags.finite;
    state.flags.fast_turns += flags.fast_turns;
    state.flags.half_turns += flags.half_turns;
    ++state.step;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void fill_coupled(const Plan<T>&, CoupledLanesPlan<T>&);                                                  \
    template void pack(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&,                   \
                       const std::vector<Vector3<T>>&);                                                                \
    template void unpack(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&);                \
    template void coupled_lanes_step(const Plan<T>&, const CoupledLanesPlan<T>&, State<T>&, CoupledLanesState<T>&,     \
                                     StageClock*);
#include "../base/instantiate.inc"

} // namespace bough::fast
