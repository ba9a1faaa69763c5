#include "analytic_lanes_step.h"
#include "../stages/external_forces.h"
#include "../stages/wind.h"
#include "lane_memory.h"
#include "targets.h"
#include <algorithm>

namespace bough::fast {
namespace {

// A pad, a body that is none, goes with its parent and hands on as good as nothing: an inertia [kg m^2] whose eigenvalues can be
// found. Its spring is neither soft nor stiff over any step, so that no kernel takes a case for it that the bodies beside it do not
// need; nothing bends it, and its motion stays 0.
template <class T> constexpr T pad_inertia = sizeof(T) == 4 ? T(1e-20) : T(1e-40);
template <class T> constexpr T pad_rate2 = T(1e4); // [1/s^2] K over inertia

template <class T> bool shorten(T* theta) {
    Vector3<T> t(theta[0], theta[1], theta[2]);
    if (!shorten_rotation(t)) return false;
    for (int k = 0; k < 3; ++k) theta[k] = t[k];
    return true;
}

template <class T> int record_inward(const Plan<T>& plan) {
    return analytic::inward_count(plan.wind, !plan.pulls.empty());
}

template <class T> AnalyticRows<T> rows_of(const Plan<T>& plan, State<T>& state) {
    Lanes<T>& lanes = state.lanes;
    const Layout& layout = plan.lanes.layout;
    const double middle = (double(state.step) + 0.5) * plan.dt;
    AnalyticRows<T> rows{};
    rows.groups = layout.groups.data();
    rows.base = layout.base.data();
    rows.landing = layout.landing.data();
    rows.fork = layout.fork.data();
    rows.fork_of_row = layout.fork_of_row.data();
    rows.constants = plan.lanes.constants.front().lane;
    rows.motion = data(lanes.now);
    rows.outward_records = data(lanes.outward);
    rows.inward_records = data(lanes.inward);
    rows.h = T(plan.dt);
    put(rows.gravity, plan.scene.gravity);
    if (plan.wind) {
        put(rows.wind, wind_velocity(*plan.scene.wind, middle));
        rows.profile = plan.lanes.profile.data();
        rows.profile_entries = plan.lanes.profile.size();
        rows.per_metre = plan.lanes.per_metre;
    }
    rows.shorten = shorten<T>;
    if (lanes.pulls.empty()) return rows;
    rows.pull_of_row = plan.lanes.pull_of_row.data();
    rows.pulls = lanes.pulls.data();
    rows.pull_count = lanes.pulls.size();
    for (std::size_t k = 0; k < lanes.pulls.size(); ++k)
        put(lanes.pulls[k].force, pull_force(plan.scene.pulls[plan.pulls[plan.lanes.pull[k]].source], middle));
    return rows;
}

SweepFlags sum(const SweepFlags& a, const SweepFlags& b) {
    SweepFlags s;
    s.half_turns = a.half_turns + b.half_turns;
    s.buckling = a.buckling + b.buckling;
    s.bounded_lambda = a.bounded_lambda + b.bounded_lambda;
    s.energy_guard = a.energy_guard + b.energy_guard;
    s.finite = a.finite && b.finite;
    return s;
}

template <class T> SweepFlags sweep(const Plan<T>& plan, State<T>& state, const AnalyticRows<T>& rows) {
    const AnalyticSweeps<T> sweeps =
        analytic_sweeps_for<T>(plan.target, {plan.wind, !plan.pulls.empty(), plan.gravity});
    const std::vector<Block>& blocks = plan.lanes.layout.blocks;
    Lanes<T>& lanes = state.lanes;
    std::size_t most = 0;
    for (std::size_t b = 1; b < blocks.size(); ++b)
        most = std::max(most, std::size_t(blocks[b].end_row - blocks[b].first_row));
    const auto threads = std::size_t(most_threads());
    if (lanes.scratch.size() < threads + 1) lanes.scratch.resize(threads + 1);
    const auto room = [](RowVector<T>& scratch, std::size_t rows_of_block) {
        const std::size_t size = rows_of_block * analytic::loaded::count;
        if (scratch.size() < size) scratch.resize(size);
        return data(scratch);
    };
    std::vector<SweepFlags>& flags = lanes.flags;
    flags.assign(blocks.size(), SweepFlags{});
    T* top_scratch = room(lanes.scratch[threads], blocks[0].end_row - blocks[0].first_row);
    sweeps.outward(rows, blocks[0], top_scratch, flags[0]);
    const auto n = std::int64_t(blocks.size());
#pragma omp parallel for schedule(dynamic, 1) if (n > 2)
    for (std::int64_t b = 1; b < n; ++b) {
        T* scratch = room(lanes.scratch[std::size_t(this_thread())], most);
        sweeps.outward(rows, blocks[std::size_t(b)], scratch, flags[std::size_t(b)]);
        sweeps.inward(rows, blocks[std::size_t(b)], scratch, flags[std::size_t(b)]);
    }
    const int count = record_inward(plan);
    for (const Port& port : plan.lanes.layout.ports)
        for (int k = 0; k < count; ++k) {
            T& part = entry(lanes.inward, port.joint, count, k);
            entry(lanes.inward, port.fork, count, k) += part;
            part = 0;
        }
    sweeps.inward(rows, blocks[0], top_scratch, flags[0]);
    SweepFlags met;
    for (const SweepFlags& f : flags) met = sum(met, f);
    return met;
}

} // namespace

template <class T> void fill_analytic(const Plan<T>& plan, PlannedLanes<T>& lanes) {
    const int count = analytic::constants(plan.wind);
    lanes.constants.assign(std::size_t(lanes.layout.rows) * std::size_t(count), Row<T>{});
    for (std::size_t slot = 0; slot < lanes.layout.body.size(); ++slot) {
        const Slot<T> row(lanes.constants, count, slot);
        const std::int32_t body = lanes.layout.body[slot];
        if (body < 0) {
            row.put(analytic::constant::R_pj, T(1));
            row.put(analytic::constant::inertia_joint, Matrix3<T>(pad_inertia<T> * Matrix3<T>::Identity()));
            row.put(analytic::constant::K, Vector3<T>(Vector3<T>::Constant(pad_inertia<T> * pad_rate2<T>)));
            row.put(analytic::constant::bend, T(1));
            row.put(analytic::constant::twist, T(1));
            continue;
        }
        const auto i = std::size_t(body);
        const Eigen::Quaternion<double> q(Mat3(plan.R_pj[i].template cast<double>()));
        row.put(analytic::constant::R_pj, T(q.w()));
        row.put(analytic::constant::R_pj + 1, Vector3<T>(q.vec().template cast<T>()));
        row.put(analytic::constant::joint_position, plan.joint_position[i]);
        row.put(analytic::constant::com, plan.com[i]);
        row.put(analytic::constant::mass, plan.mass[i]);
        row.put(analytic::constant::inertia_joint, plan.inertia_joint[i]);
        row.put(analytic::constant::K, plan.K[i]);
        row.put(analytic::constant::beta, plan.beta[i]);
        row.put(analytic::constant::bend, plan.inertia_factor[i][0]); // x and y alike (plan.cpp)
        row.put(analytic::constant::twist, plan.inertia_factor[i][2]);
        if (plan.gravity) row.put(analytic::constant::gravity_row, plan.gravity_row[i]);
        if (!plan.wind) continue;
        row.put(analytic::constant::sway, plan.sway[i]);
        row.put(analytic::constant::joint_distance, plan.joint_distance[i]);
        row.put(analytic::constant::com_distance, plan.com_distance[i]);
        row.put(analytic::constant::inverse_weight, plan.inverse_weight[i]);
        row.put(analytic::constant::drag_area, plan.drag_area[i]);
    }
}

template <class T> void pack_analytic(const Plan<T>& plan, State<T>& state) {
    const Layout& layout = plan.lanes.layout;
    Lanes<T>& lanes = state.lanes;
    lanes.now.resize(std::size_t(layout.rows) * analytic::motion::count);
    const auto records = [&](RowVector<T>& rows, int count) {
        rows.resize(layout.joints * record(count, Row<T>::lanes) / Row<T>::lanes);
    };
    records(lanes.outward, analytic::outward::count);
    records(lanes.inward, record_inward(plan));
    for (int k = 0; k < 3; ++k)
        entry(lanes.outward, 0, analytic::outward::count, analytic::outward::R_bw + 4 * k) = 1; // the ground
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Slot<T> row(lanes.now, analytic::motion::count, layout.slot[i]);
        row.put(analytic::motion::theta, state.theta[i]);
        row.put(analytic::motion::theta_dot, state.theta_dot[i]);
        row.put(analytic::motion::scaled_rate, state.scaled_rate[i]);
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

template <class T> void unpack_analytic(const Plan<T>& plan, State<T>& state) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Slot<T> row(state.lanes.now, analytic::motion::count, plan.lanes.layout.slot[i]);
        state.theta[i] = row.vector(analytic::motion::theta);
        state.theta_dot[i] = row.vector(analytic::motion::theta_dot);
        state.scaled_rate[i] = row.vector(analytic::motion::scaled_rate);
    }
}

template <class T> void analytic_lanes_step(const Plan<T>& plan, State<T>& state, StageClock* clock) {
    SweepFlags met;
    run_stage(Stage::lanes, state, clock, [&] { met = sweep(plan, state, rows_of(plan, state)); });
    state.lanes.presented = false;
    state.lanes.finite = met.finite;
    state.flags.buckling += met.buckling;
    state.flags.bounded_lambda += met.bounded_lambda;
    state.flags.half_turns += met.half_turns;
    state.flags.energy_guard += met.energy_guard;
    ++state.step;
}

template void fill_analytic(const Plan<float>&, PlannedLanes<float>&);
template void fill_analytic(const Plan<double>&, PlannedLanes<double>&);
template void pack_analytic(const Plan<float>&, State<float>&);
template void pack_analytic(const Plan<double>&, State<double>&);
template void unpack_analytic(const Plan<float>&, State<float>&);
template void unpack_analytic(const Plan<double>&, State<double>&);
template void analytic_lanes_step(const Plan<float>&, State<float>&, StageClock*);
template void analytic_lanes_step(const Plan<double>&, State<double>&, StageClock*);

} // namespace bough::fast
