#include "coupled_lanes_step.h"
#include "../coupled/half_turn.h"
#include "../coupled/midpoint.h"
#include "../stages/external_forces.h"
#include "../stages/root_term.h"
#include "../stages/spring.h"
#include "../stages/state_update.h"
#include "analytic_lanes_step.h"
#include "energy_lanes.h"
#include "lane_memory.h"
#include "present.h"
#include "sleep.h"
#include "step_bytes.h"
#include "targets.h"
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

template <class T> void place_grounds(const Plan<T>& plan, State<T>& state, double time, std::complex<double> slope) {
    ground_over_step(plan, state, time);
    Lanes<T>& lanes = state.lanes;
    for (std::size_t joint = 0; joint < plan.lanes.layout.grounds; ++joint) {
        Matrix3<T> R = Matrix3<T>::Identity();
        if (joint > 0) {
            const GroundStep<T>& g = state.coupled_ground[joint - 1];
            R = g.R;
            entry(lanes.outward, joint, outward::count, outward::y) = g.x.y();
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

template <class T> void place_pulls(const Plan<T>& plan, State<T>& state, double time) {
    for (std::size_t k = 0; k < state.lanes.pulls.size(); ++k) {
        const PlannedPull<T>& planned = plan.pulls[plan.lanes.pull[k]];
        const Pull& source = plan.scene.pulls[planned.source];
        PullOnLane<T>& pull = state.lanes.pulls[k];
        put(pull.force, pull_force(source, time + plan.dt / 2));
        put(pull.change, pull_force(source, time + plan.dt) - pull_force(source, time));
    }
}

// For the solve of the scheme's pole k.
template <class T> CoupledRows<T> rows_of(const Plan<T>& plan, State<T>& state, double time, int k) {
    Lanes<T>& lanes = state.lanes;
    const Layout& layout = plan.lanes.layout;
    const Pole pole = scheme_of(plan.scheme).pole[std::size_t(k)];
    const double h = plan.dt;
    const std::complex<double> slope = 1.0 / pole.p - 0.5;
    CoupledRows<T> rows{};
    rows.groups = layout.groups.data();
    rows.base = layout.base.data();
    rows.landing = layout.landing.data();
    rows.fork = layout.fork.data();
    rows.fork_of_row = layout.fork_of_row.data();
    rows.constants = plan.lanes.constants.front().lane;
    rows.now = data(lanes.now);
    rows.next = data(lanes.next);
    rows.solved_rows = data(lanes.solved);
    rows.outward_records = data(lanes.outward);
    rows.inward_records = data(lanes.inward);
    rows.accelerated_records = data(lanes.accelerated);
    rows.pull_of_row = plan.lanes.pull_of_row.empty() ? nullptr : plan.lanes.pull_of_row.data();
    rows.pulls = lanes.pulls.empty() ? nullptr : lanes.pulls.data();
    rows.pull_count = lanes.pulls.size();
    rows.watched = lanes.watched.data();
    rows.stream = streams(layout);
    rows.adds = k > 0;
    rows.ends = k + 1 == scheme_of(plan.scheme).poles;
    rows.h = T(h);
    put(rows.s1, h / pole.p);
    put(rows.s2, h / pole.p * h / pole.p);
    put(rows.slope, slope);
    // x_v = -x / p, x_u = (h x_v - eta_0) / p; the changes are h 2 Re (c x_v), h 2 Re (c x_u).
    put(rows.of_rate, -2 * h * pole.c / pole.p);
    put(rows.of_angle, -2 * h * h * pole.c / (pole.p * pole.p));
    rows.eta = T((-2 * h * pole.c / pole.p).real());
    put(rows.gravity, plan.scene.gravity);
    if (plan.wind) {
        const Wind& wind = *plan.scene.wind;
        put(rows.wind, wind_velocity(wind, time + h / 2));
        put(rows.wind_change, wind_velocity(wind, time + h) - wind_velocity(wind, time));
        rows.profile = plan.lanes.profile.data();
        rows.profile_entries = plan.lanes.profile.size();
        rows.per_metre = plan.lanes.per_metre;
    }
    rows.shorten = shorten<T>;
    place_grounds(plan, state, time, slope);
    place_pulls(plan, state, time);
    return rows;
}

SweepFlags operator+(const SweepFlags& a, const SweepFlags& b) {
    SweepFlags s;
    s.fast_turns = a.fast_turns + b.fast_turns;
    s.half_turns = a.half_turns + b.half_turns;
    s.fast = a.fast || b.fast;
    s.finite = a.finite && b.finite;
    s.omega2 = std::max(a.omega2, b.omega2);
    return s;
}

// What blocks hand to the top. A sleeper's stands until it wakes.
template <class T> void add_ports(const Plan<T>& plan, State<T>& state) {
    const std::vector<Port>& ports = plan.lanes.layout.ports;
    for (std::size_t p = 0; p < ports.size(); ++p) {
        const bool stands = plan.lanes.sleep.on && rest_of(state, plan.lanes.sleep.block_of_port[p]) != Rest::awake;
        for (int k = 0; k < inward::count; ++k) {
            T& part = entry(state.lanes.inward, ports[p].joint, inward::count, k);
            entry(state.lanes.inward, ports[p].fork, inward::count, k) += part;
            if (!stands) part = 0;
        }
    }
}

template <class T> SweepFlags sweep(const Plan<T>& plan, State<T>& state, const CoupledRows<T>& rows) {
    const CoupledSweeps<T> sweeps = coupled_sweeps_for<T>(plan.target, plan.wind, plan.gravity);
    const std::vector<Block>& blocks = plan.lanes.layout.blocks;
    Lanes<T>& lanes = state.lanes;
    std::size_t most = 0;
    for (std::size_t b = 1; b < blocks.size(); ++b)
        most = std::max(most, std::size_t(blocks[b].end_row - blocks[b].first_row));
    const auto threads = std::size_t(most_threads());
    if (lanes.scratch.size() < threads + 1) lanes.scratch.resize(threads + 1);
    const auto room = [](RowVector<T>& scratch, std::size_t rows_of_block) {
        const std::size_t size = rows_of_block * (std::size_t(loaded::count) + solved::count);
        if (scratch.size() < size) scratch.resize(size);
        return data(scratch);
    };
    std::vector<SweepFlags>& flags = lanes.flags;
    flags.assign(blocks.size(), SweepFlags{});
    SweepFlags& top = flags[0];
    const Rest rest_of_top = rest_of(state, 0);
    T* top_scratch = room(lanes.scratch[threads], blocks[0].end_row - blocks[0].first_row);
    if (rest_of_top == Rest::awake) sweeps.outward(rows, blocks[0], top_scratch, top);
    if (rest_of_top == Rest::settling) keep_motion(state, blocks[0]);
    const auto n = std::int64_t(blocks.size());
#pragma omp parallel for schedule(dynamic, 1) if (n > 2)
    for (std::int64_t b = 1; b < n; ++b) {
        const Block& block = blocks[std::size_t(b)];
        const Rest rest = rest_of(state, std::size_t(b));
        if (rest == Rest::settling) keep_motion(state, block);
        if (rest == Rest::asleep || (rest == Rest::settling && block.whole)) continue;
        SweepFlags& met = flags[std::size_t(b)];
        T* scratch = room(lanes.scratch[std::size_t(this_thread())], most);
        CoupledRows<T> mine = rows;
        if (block.whole) { // nothing to wait for: what is solved stays in the cache
            mine.solved_rows = scratch + most * std::size_t(loaded::count) * Row<T>::lanes;
            mine.solved_first = block.first_row;
            mine.stream = false;
        }
        sweeps.outward(mine, block, scratch, met);
        sweeps.inward(mine, block, scratch);
        if (block.whole) sweeps.accelerate(mine, block, met);
    }
    if (rest_of_top == Rest::awake) {
        add_ports(plan, state);
        sweeps.inward(rows, blocks[0], top_scratch);
        sweeps.accelerate(rows, blocks[0], top);
    }
#pragma omp parallel for schedule(dynamic, 1) if (n > 2)
    for (std::int64_t b = n - 1; b > 0; --b)
        if (!blocks[std::size_t(b)].whole && rest_of(state, std::size_t(b)) == Rest::awake)
            sweeps.accelerate(rows, blocks[std::size_t(b)], flags[std::size_t(b)]);
    SweepFlags all;
    for (const SweepFlags& f : flags) all = all + f;
    return all;
}

template <class T> void unpack(const Plan<T>& plan, State<T>& state) {
    const Layout& layout = plan.lanes.layout;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const std::size_t slot = layout.slot[i], row = slot / Row<T>::lanes, lane = slot % Row<T>::lanes;
        const auto get = [&](int quantity) {
            Vector3<T> v;
            for (int k = 0; k < 3; ++k)
                v[k] = state.lanes.now[row * motion::count + std::size_t(quantity + k)].lane[lane];
            return v;
        };
        state.theta[i] = get(motion::theta);
        state.theta_dot[i] = get(motion::theta_dot);
        state.theta_change[i] = get(motion::theta_change);
        state.theta_dot_change[i] = get(motion::theta_dot_change);
    }
}

} // namespace

template <class T> void pack(const Plan<T>& plan, State<T>& state) {
    const Layout& layout = plan.lanes.layout;
    Lanes<T>& lanes = state.lanes;
    lanes.now.resize(std::size_t(layout.rows) * motion::count);
    lanes.next.resize(lanes.now.size());
    if (waits(layout)) lanes.solved.resize(std::size_t(layout.rows) * solved::count);
    const auto records = [&](RowVector<T>& rows, int count) {
        rows.resize(layout.joints * record(count, Row<T>::lanes) / Row<T>::lanes);
    };
    lanes.watched.assign(layout.base.size(), 0);
    if (plan.lanes.sleep.on) lanes.rest.assign(layout.blocks.size(), BlockRest{});
    lanes.carried_turn = 0;
    records(lanes.outward, outward::count);
    records(lanes.inward, inward::count);
    std::fill(lanes.inward.begin(), lanes.inward.end(), Row<T>{}); // of sleepers', which are awake now
    records(lanes.accelerated, accelerated::count);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const std::size_t slot = layout.slot[i], row = slot / Row<T>::lanes, lane = slot % Row<T>::lanes;
        const auto set = [&](int quantity, const Vector3<T>& v) {
            for (int k = 0; k < 3; ++k) lanes.now[row * motion::count + std::size_t(quantity + k)].lane[lane] = v[k];
        };
        set(motion::theta, state.theta[i]);
        set(motion::theta_dot, state.theta_dot[i]);
        set(motion::theta_change, state.theta_change[i]);
        set(motion::theta_dot_change, state.theta_dot_change[i]);
    }
    lanes.pulls.clear();
    for (std::size_t k : plan.lanes.pull) {
        const std::size_t slot = layout.slot[plan.pulls[k].body];
        PullOnLane<T> pull{std::uint32_t(slot / Row<T>::lanes), std::uint32_t(slot % Row<T>::lanes), {}, {}, {}};
        for (int j = 0; j < 3; ++j) pull.point[j] = plan.pulls[k].point_b[j];
        lanes.pulls.push_back(pull);
    }
    lanes.presented = true;
}

template <class T> void coupled_lanes_step(const Plan<T>& plan, State<T>& state, StageClock* clock) {
    const double time = double(state.step) * plan.dt;
    wake_blocks(plan, state, time);
    if (all_asleep(state)) { // what present has made stays as it is
        ++state.step;
        return;
    }
    SweepFlags flags;
    run_stage(Stage::lanes, state, clock, [&] {
        CoupledRows<T> rows = rows_of(plan, state, time, 0);
        flags = sweep(plan, state, rows);
        for (int k = 1; k < scheme_of(plan.scheme).poles; ++k) {
            rows = rows_of(plan, state, time, k);
            const SweepFlags solved = sweep(plan, state, rows); // its way outward has met with the same as the first
            flags.half_turns = solved.half_turns;
            flags.fast = solved.fast;
            flags.finite = solved.finite;
        }
        rest_blocks(plan, state, state.lanes.flags);
        if (!flags.fast) return;
        guard_lanes(plan, state, rows);
        std::fill(state.lanes.watched.begin(), state.lanes.watched.end(), std::uint8_t(0));
    });
    state.lanes.now.swap(state.lanes.next);
    state.lanes.presented = false;
    state.lanes.finite = flags.finite;
    state.flags.fast_turns += flags.fast_turns;
    state.flags.half_turns += flags.half_turns;
    ++state.step;
}

template void pack(const Plan<float>&, State<float>&);
template void pack(const Plan<double>&, State<double>&);
template void coupled_lanes_step(const Plan<float>&, State<float>&, StageClock*);
template void coupled_lanes_step(const Plan<double>&, State<double>&, StageClock*);

} // namespace bough::fast

namespace bough {

template <class T> void present(const Plan<T>& plan, State<T>& state) {
    if (!plan.lanes.on || state.lanes.presented) return;
    if (plan.solver == Solver::analytic)
        fast::unpack_analytic(plan, state);
    else
        fast::unpack(plan, state);
    move_ground(plan, state, double(state.step) * plan.dt);
    state_update(plan, state);
    if (plan.torque) spring_torque(plan, state);
    state.lanes.presented = true;
}

template void present(const Plan<float>&, State<float>&);
template void present(const Plan<double>&, State<double>&);

} // namespace bough
