#include "lane_tables.h"
#include "../stages/external_forces.h"
#include "../stages/wind.h"
#include "analytic_rows.h"
#include "sleep.h"
#include <algorithm>

namespace bough::fast {

template <class T> void put_body(const Plan<T>& plan, std::size_t i, const Slot<T>& row) {
    const Eigen::Quaternion<double> q(Mat3(plan.R_pj[i].template cast<double>()));
    row.put(body_constant::R_pj, T(q.w()));
    row.put(body_constant::R_pj + 1, Vector3<T>(q.vec().template cast<T>()));
    row.put(body_constant::joint_position, plan.joint_position[i]);
    row.put(body_constant::com, plan.com[i]);
    row.put(body_constant::mass, plan.mass[i]);
    row.put(body_constant::K, plan.K[i]);
    row.put(body_constant::beta, plan.beta[i]);
}

template <class T> void resize_records(const Layout& layout, RowVector<T>& records, int count) {
    records.resize(layout.joints * record(count, Row<T>::lanes) / Row<T>::lanes);
}

template <class T> void pack_pulls(const Plan<T>& plan, State<T>& state) {
    state.lanes.pulls.clear();
    for (std::size_t k : plan.lanes.pull) {
        const std::size_t slot = plan.lanes.layout.slot[plan.pulls[k].body];
        PullOnLane<T> pull{std::uint32_t(slot / Row<T>::lanes), std::uint32_t(slot % Row<T>::lanes), {}, {}, {}};
        for (int j = 0; j < 3; ++j) pull.point[j] = plan.pulls[k].point_b[j];
        state.lanes.pulls.push_back(pull);
    }
}

template <class T> void place_tables(const Plan<T>& plan, State<T>& state, double middle, SweepRows<T>& rows) {
    Lanes<T>& lanes = state.lanes;
    const Layout& layout = plan.lanes.layout;
    rows.groups = layout.groups.data();
    rows.base = layout.base.data();
    rows.landing = layout.landing.data();
    rows.fork = layout.fork.data();
    rows.fork_of_row = layout.fork_of_row.data();
    rows.constants = plan.lanes.constants.front().lane;
    rows.outward_records = data(lanes.outward);
    rows.inward_records = data(lanes.inward);
    rows.h = T(plan.dt);
    put(rows.gravity, plan.scene.gravity);
    if (plan.wind) {
        put(rows.wind, wind_velocity(*plan.scene.wind, middle));
        rows.profile = plan.lanes.profile.data();
        rows.profile_entries = plan.lanes.profile.size();
        rows.per_metre = plan.lanes.per_metre;
        rows.leaf = plan.leaf;
    }
    if (lanes.pulls.empty()) return;
    rows.pull_of_row = plan.lanes.pull_of_row.data();
    rows.pulls = lanes.pulls.data();
    rows.pull_count = lanes.pulls.size();
    for (std::size_t k = 0; k < lanes.pulls.size(); ++k)
        put(lanes.pulls[k].force, pull_force(plan.scene.pulls[plan.pulls[plan.lanes.pull[k]].source], middle));
}

template <class T> void place_block(const Plan<T>& plan, State<T>& state, const Block& block, CoupledRows<T>& rows) {
    const CoupledPlaces places = places_of(plan, state, block);
    T* const table = data(state.lanes.table);
    constexpr std::ptrdiff_t lanes = Row<T>::lanes;
    rows.first_row = block.first_row;
    rows.now = table + places.now.first * lanes;
    rows.next = table + places.next.first * lanes;
    rows.solved_rows = table + places.solved.first * lanes;
    rows.now_stride = places.now.stride;
    rows.next_stride = places.next.stride;
    rows.solved_stride = places.solved.stride;
}

template <class T> std::vector<std::size_t> motion_of_rows(const Plan<T>& plan, const State<T>& state) {
    const Layout& layout = plan.lanes.layout;
    std::vector<std::size_t> at(layout.rows);
    for (const Block& block : layout.blocks) {
        const Run now = plan.solver == Solver::analytic
                            ? Run{std::ptrdiff_t(block.first_row) * analytic::motion::count, analytic::motion::count}
                            : places_of(plan, state, block).now;
        for (std::uint32_t row = block.first_row; row < block.end_row; ++row)
            at[row] = std::size_t(now.at(row - block.first_row));
    }
    return at;
}

template <class T> void add_ports(const Plan<T>& plan, State<T>& state, int count) {
    const std::vector<Port>& ports = plan.lanes.layout.ports;
    for (std::size_t p = 0; p < ports.size(); ++p) {
        const bool stands = plan.lanes.sleep.on && rest_of(state, plan.lanes.sleep.block_of_port[p]) != Rest::awake;
        for (int k = 0; k < count; ++k) {
            T& part = entry(state.lanes.inward, ports[p].joint, count, k);
            entry(state.lanes.inward, ports[p].fork, count, k) += part;
            if (!stands) part = 0;
        }
    }
}

std::size_t largest_block(const Layout& layout) {
    std::size_t most = 0;
    for (std::size_t b = 1; b < layout.blocks.size(); ++b)
        most = std::max(most, std::size_t(layout.blocks[b].end_row - layout.blocks[b].first_row));
    return most;
}

template <class T> std::size_t share_scratch(Lanes<T>& lanes) {
    const auto threads = std::size_t(most_threads());
    if (lanes.scratch.size() < threads + 1) lanes.scratch.resize(threads + 1);
    return threads;
}

template void put_body(const Plan<float>&, std::size_t, const Slot<float>&);
template void resize_records(const Layout&, RowVector<float>&, int);
template void pack_pulls(const Plan<float>&, State<float>&);
template void place_tables(const Plan<float>&, State<float>&, double, SweepRows<float>&);
template void place_block(const Plan<float>&, State<float>&, const Block&, CoupledRows<float>&);
template std::vector<std::size_t> motion_of_rows(const Plan<float>&, const State<float>&);
template void add_ports(const Plan<float>&, State<float>&, int);
template std::size_t share_scratch(Lanes<float>&);
template void put_body(const Plan<double>&, std::size_t, const Slot<double>&);
template void resize_records(const Layout&, RowVector<double>&, int);
template void pack_pulls(const Plan<double>&, State<double>&);
template void place_tables(const Plan<double>&, State<double>&, double, SweepRows<double>&);
template void place_block(const Plan<double>&, State<double>&, const Block&, CoupledRows<double>&);
template std::vector<std::size_t> motion_of_rows(const Plan<double>&, const State<double>&);
template void add_ports(const Plan<double>&, State<double>&, int);
template std::size_t share_scratch(Lanes<double>&);

} // namespace bough::fast
