#include "analytic_lanes_step.h"
#include "../base/parallel.h"
#include "../lanes/lane_tables.h"
#include "../lanes/shared_constants.h"
#include "analytic_stepper.h"
#include "analytic_targets.h"
#include <algorithm>

namespace bough::fast {
namespace {

template <class T> bool shorten(T* theta) {
    Vector3<T> t(theta[0], theta[1], theta[2]);
    if (!shorten_rotation(t)) return false;
    for (int k = 0; k < 3; ++k) theta[k] = t[k];
    return true;
}

template <class T> int record_inward(const Plan<T>& plan) {
    return analytic::inward_count(plan.wind, plan.pushes());
}

template <class T>
AnalyticRows<T> rows_of(const Plan<T>& plan, const AnalyticLanesPlan<T>& own, State<T>& state,
                        AnalyticLanesState<T>& work) {
    AnalyticRows<T> rows{};
    place_tables<T>(plan, own.lanes, state, work.lanes, time_of(plan, state, 0.5), rows);
    rows.motion = data(work.lanes.now);
    rows.shorten = shorten<T>;
    return rows;
}

template <class T>
SweepFlags sweep(const Plan<T>& plan, const AnalyticLanesPlan<T>& own, AnalyticLanesState<T>& work,
                 const AnalyticRows<T>& rows) {
    const AnalyticSweeps<T> sweeps = analytic_sweeps_for<T>(own.lanes.target, sweep_loads(plan));
    const std::vector<Block>& blocks = own.lanes.layout.blocks;
    Lanes<T>& lanes = work.lanes;
    const std::size_t count =
        std::size_t(analytic::loaded::count + (plan.foliage ? analytic::leaf_torque_count : 0)); // a row
    share_scratch(own.lanes.layout, lanes, (blocks[0].end_row - blocks[0].first_row) * count,
                  largest_block(own.lanes.layout) * count);
    std::vector<SweepFlags>& flags = lanes.flags;
    flags.assign(blocks.size(), SweepFlags{});
    T* top_scratch = data(lanes.scratch[0]);
    sweeps.outward(rows, blocks[0], top_scratch, flags[0]);
    parallel_blocks(blocks.size() - 1, block_cost(own.lanes.layout), [&](std::size_t k, int worker) {
        const std::size_t b = 1 + k;
        T* scratch = data(lanes.scratch[1 + std::size_t(worker)]);
        sweeps.outward(rows, blocks[b], scratch, flags[b]);
        sweeps.inward(rows, blocks[b], scratch, flags[b]);
    });
    add_ports(own.lanes, work.lanes, record_inward(plan));
    sweeps.inward(rows, blocks[0], top_scratch, flags[0]);
    SweepFlags met;
    for (const SweepFlags& f : flags) met += f;
    return met;
}

} // namespace

template <class T> void fill_analytic(const Plan<T>& plan, AnalyticLanesPlan<T>& own) {
    const auto body = [&](std::size_t i, const Slot<T>& row) {
        put_body(plan, i, row);
        row.put(analytic::constant::inertia_joint, plan.inertia_joint[i]);
        row.put(analytic::constant::bend, own.inertia_factor[i][0]); // x and y alike (analytic_constants.cpp)
        row.put(analytic::constant::twist, own.inertia_factor[i][2]);
        if (plan.gravity) row.put(analytic::constant::gravity_row, own.gravity_row[i]);
        if (!plan.wind) return;
        row.put(analytic::constant::sway, own.sway[i]);
        row.put(analytic::constant::joint_distance, own.joint_distance[i]);
        row.put(analytic::constant::com_distance, own.com_distance[i]);
        row.put(analytic::constant::inverse_weight, own.inverse_weight[i]);
        row.put(analytic::constant::drag_area, plan.drag_area[i]);
    };
    fill_constants(own.lanes, analytic::constants(plan.wind), put_analytic_pad<T>, body);
}

template <class T>
void pack_analytic(const Plan<T>& plan, const AnalyticLanesPlan<T>& own, State<T>& state, AnalyticLanesState<T>& work,
                   const std::vector<Vector3<T>>& theta) {
    const Layout& layout = own.lanes.layout;
    Lanes<T>& lanes = work.lanes;
    lanes.now.resize(std::size_t(layout.rows) * analytic::motion::count);
    resize_records(layout, lanes.outward, analytic::outward_count(plan.field));
    resize_records(layout, lanes.inward, record_inward(plan));
    for (int k = 0; k < 3; ++k)
        entry(lanes.outward, 0, analytic::outward_count(plan.field), analytic::outward::R_bw + 4 * k) = 1; // the ground
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Slot<T> row(lanes.now, analytic::motion::count, layout.slot[i]);
        row.put(analytic::motion::theta, theta[i]);
        row.put(analytic::motion::theta_dot, entry(state.theta_dot, i));
        row.put(analytic::motion::scaled_rate, entry(work.scaled_rate, i));
    }
    pack_pulls(plan, own.lanes, work.lanes);
    lanes.presented = true;
}

template <class T>
void unpack_analytic(const Plan<T>& plan, const AnalyticLanesPlan<T>& own, State<T>& state,
                     AnalyticLanesState<T>& work) {
    for (auto* array : {&state.theta, &state.theta_dot, &work.scaled_rate})
        array->resize(plan.bodies); // where they were left out
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const std::size_t slot = own.lanes.layout.slot[i];
        const Slot<T> row(work.lanes.now, analytic::motion::count, slot);
        state.theta[i] = row.vector(analytic::motion::theta);
        work.scaled_rate[i] = row.vector(analytic::motion::scaled_rate);
        state.theta_dot[i] = row.vector(analytic::motion::theta_dot);
    }
}

template <class T>
void analytic_lanes_step(const Plan<T>& plan, const AnalyticLanesPlan<T>& own, State<T>& state,
                         AnalyticLanesState<T>& work, StageClock* clock) {
    SweepFlags met;
    run_stage(Stage::lanes, state, clock, [&] { met = sweep(plan, own, work, rows_of(plan, own, state, work)); });
    work.lanes.presented = false;
    work.lanes.finite = met.finite;
    state.flags.buckling += met.buckling;
    state.flags.bounded_lambda += met.bounded_lambda;
    state.flags.half_turns += met.half_turns;
    state.flags.energy_guard += met.energy_guard;
    ++state.step;
}

template <class T> void put_analytic_pad(const Slot<T>& row) {
    row.put(analytic::constant::R_pj, T(1));
    row.put(analytic::constant::inertia_joint, Matrix3<T>(pad_inertia<T> * Matrix3<T>::Identity()));
    row.put(analytic::constant::K, Vector3<T>(Vector3<T>::Constant(pad_inertia<T> * pad_rate2<T>)));
    row.put(analytic::constant::bend, T(1));
    row.put(analytic::constant::twist, T(1));
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void put_analytic_pad(const Slot<T>&);                                                                    \
    template void fill_analytic(const Plan<T>&, AnalyticLanesPlan<T>&);                                                \
    template void pack_analytic(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&,        \
                                const std::vector<Vector3<T>>&);                                                       \
    template void unpack_analytic(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&);     \
    template void analytic_lanes_step(const Plan<T>&, const AnalyticLanesPlan<T>&, State<T>&, AnalyticLanesState<T>&,  \
                                      StageClock*);
#include "../base/instantiate.inc"

} // namespace bough::fast
