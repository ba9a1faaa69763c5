#include "lane_tables.h"
#include "../base/parallel.h"
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

namespace {

template <class T> PullOnLane<T> on_lane(const Plan<T>& plan, std::size_t body, const Vector3<T>& point_b) {
    const std::size_t slot = plan.lanes.layout.slot[body];
    PullOnLane<T> pull{std::uint32_t(slot / Row<T>::lanes), std::uint32_t(slot % Row<T>::lanes), {}, {}, {}, no_source};
    for (int j = 0; j < 3; ++j) pull.point[j] = point_b[j];
    return pull;
}

// The pulls and the loads of this step, rising by row; what stands of the last step's loads goes.
template <class T> void place_loads(const Plan<T>& plan, State<T>& state) {
    Lanes<T>& lanes = state.lanes;
    const std::size_t before = lanes.pulls.size();
    std::erase_if(lanes.pulls, [&](const PullOnLane<T>& pull) {
        lanes.pull_of_row[pull.row] = -1;
        return pull.source == no_source;
    });
    if (before == 0 && state.loads.empty()) return;
    for (const Load<T>& load : state.loads) {
        PullOnLane<T> pull = on_lane(plan, load.body, load.point_b);
        put(pull.force, load.force.template cast<double>());
        lanes.pulls.push_back(pull);
    }
    for (std::size_t k = 0; k < lanes.pulls.size(); ++k) lanes.pulls[k].order = k;
    std::sort(lanes.pulls.begin(), lanes.pulls.end(), [](const PullOnLane<T>& a, const PullOnLane<T>& b) {
        return a.row != b.row ? a.row < b.row : a.order < b.order; // stable, and without the memory that that takes
    });
    for (std::size_t k = lanes.pulls.size(); k-- > 0;) lanes.pull_of_row[lanes.pulls[k].row] = std::int32_t(k);
}

} // namespace

template <class T> void pack_pulls(const Plan<T>& plan, State<T>& state) {
    state.lanes.pulls.clear();
    for (std::size_t k : plan.lanes.pull) {
        PullOnLane<T> pull = on_lane(plan, plan.pulls[k].body, plan.pulls[k].point_b);
        pull.source = plan.pulls[k].source;
        state.lanes.pulls.push_back(pull);
    }
    if (!plan.loads) return;
    state.lanes.pull_of_row = plan.lanes.pull_of_row;
    state.lanes.pull_of_row.resize(plan.lanes.layout.rows, -1);
}

namespace {

template <class T> FieldTables<T> tables_of(const WindField<T>& field) {
    return {field.velocity.data(), field.turn.empty() ? nullptr : field.turn.data()};
}

template <class T> void place_field(const Plan<T>& plan, State<T>& state, double middle, FieldRows<T>& rows) {
    evaluate_wind(*plan.scene.wind, middle, state.wind);
    const WindField<T>& field = state.wind.field;
    rows.middle = tables_of(field);
    rows.x = field.x;
    rows.z = field.z;
    rows.per_metre = field.per_metre;
    rows.columns = field.columns;
    rows.rows = field.rows;
    rows.cells = std::int32_t(field.cells());
    rows.all_cells = std::int32_t(field.velocity.size() / 3);
    rows.center_x = field.center_x;
    rows.center_z = field.center_z;
    rows.rings_per_metre = field.rings_per_metre;
    rows.rings = std::int32_t(field.rings());
    rows.all_rings = std::int32_t(field.turn.size() / 2);
    rows.shelter = plan.lanes.shelter.empty() ? nullptr : plan.lanes.shelter.front().lane;
    rows.clock = plan.lanes.clock.empty() ? nullptr : plan.lanes.clock.front().lane;
}

} // namespace

template <class T> void place_field_change(const Plan<T>& plan, State<T>& state, double time, CoupledRows<T>& rows) {
    const Wind& wind = *plan.scene.wind;
    evaluate_field(wind, time, state.wind_start);
    evaluate_field(wind, time + plan.dt, state.wind_end);
    rows.field_start = tables_of(state.wind_start);
    rows.field_end = tables_of(state.wind_end);
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
    rows.constants_row = plan.lanes.sharing.on ? plan.lanes.sharing.row.data() : nullptr;
    rows.outward_records = data(lanes.outward);
    rows.inward_records = data(lanes.inward);
    rows.h = T(plan.dt);
    put(rows.gravity, plan.scene.gravity);
    if (plan.wind) {
        if (plan.field)
            place_field(plan, state, middle, rows.field);
        else
            put(rows.wind, wind_velocity(*plan.scene.wind, middle));
        rows.profile = plan.lanes.profile.data();
        rows.profile_entries = plan.lanes.profile.size();
        rows.per_metre = plan.lanes.per_metre;
        rows.leaf = plan.leaf;
    }
    if (plan.loads) place_loads(plan, state);
    if (lanes.pulls.empty()) return;
    rows.pull_of_row = plan.loads ? lanes.pull_of_row.data() : plan.lanes.pull_of_row.data();
    rows.pulls = lanes.pulls.data();
    rows.pull_count = lanes.pulls.size();
    for (PullOnLane<T>& pull : lanes.pulls)
        if (pull.source != no_source) put(pull.force, pull_force(plan.scene.pulls[pull.source], middle));
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

template <class T> void scale_wood(Plan<T>& plan, T stiffness, T damping) {
    RowVector<T>& constants = plan.lanes.constants;
    for (std::size_t row = 0; row + constant::count <= constants.size(); row += constant::count)
        for (std::size_t l = 0; l < Row<T>::lanes; ++l) {
            for (int k = 0; k < 3; ++k) constants[row + constant::K + k].lane[l] *= stiffness;
            constants[row + constant::beta].lane[l] *= damping;
        }
}

template <class T> void motion_of_rows(const Plan<T>& plan, const State<T>& state, std::vector<std::size_t>& at) {
    const Layout& layout = plan.lanes.layout;
    at.resize(layout.rows);
    for (const Block& block : layout.blocks) {
        const Run now = plan.solver == Solver::analytic
                            ? Run{std::ptrdiff_t(block.first_row) * analytic::motion::count, analytic::motion::count}
                            : places_of(plan, state, block).now;
        for (std::uint32_t row = block.first_row; row < block.end_row; ++row)
            at[row] = std::size_t(now.at(row - block.first_row));
    }
}

template <class T> std::vector<std::size_t> motion_of_rows(const Plan<T>& plan, const State<T>& state) {
    std::vector<std::size_t> at;
    motion_of_rows(plan, state, at);
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

double block_cost(const Layout& layout) {
    return row_cost * double(layout.rows) / double(layout.blocks.size());
}

template <class T> void share_scratch(const Layout& layout, Lanes<T>& lanes, std::size_t top, std::size_t each) {
    const std::size_t blocks = layout.blocks.size() - 1;
    const auto threads = std::size_t(threads_for(blocks, block_cost(layout) * double(blocks)));
    if (lanes.scratch.size() < threads + 1) lanes.scratch.resize(threads + 1);
    room(lanes.scratch[0], top);
    for (std::size_t thread = 0; thread < threads; ++thread) room(lanes.scratch[1 + thread], each);
}

template void put_body(const Plan<float>&, std::size_t, const Slot<float>&);
template void resize_records(const Layout&, RowVector<float>&, int);
template void pack_pulls(const Plan<float>&, State<float>&);
template void place_tables(const Plan<float>&, State<float>&, double, SweepRows<float>&);
template void place_field_change(const Plan<float>&, State<float>&, double, CoupledRows<float>&);
template void place_block(const Plan<float>&, State<float>&, const Block&, CoupledRows<float>&);
template void scale_wood(Plan<float>&, float, float);
template void scale_wood(Plan<double>&, double, double);
template std::vector<std::size_t> motion_of_rows(const Plan<float>&, const State<float>&);
template void motion_of_rows(const Plan<float>&, const State<float>&, std::vector<std::size_t>&);
template void add_ports(const Plan<float>&, State<float>&, int);
template void share_scratch(const Layout&, Lanes<float>&, std::size_t, std::size_t);
template void put_body(const Plan<double>&, std::size_t, const Slot<double>&);
template void resize_records(const Layout&, RowVector<double>&, int);
template void pack_pulls(const Plan<double>&, State<double>&);
template void place_tables(const Plan<double>&, State<double>&, double, SweepRows<double>&);
template void place_field_change(const Plan<double>&, State<double>&, double, CoupledRows<double>&);
template void place_block(const Plan<double>&, State<double>&, const Block&, CoupledRows<double>&);
template std::vector<std::size_t> motion_of_rows(const Plan<double>&, const State<double>&);
template void motion_of_rows(const Plan<double>&, const State<double>&, std::vector<std::size_t>&);
template void add_ports(const Plan<double>&, State<double>&, int);
template void share_scratch(const Layout&, Lanes<double>&, std::size_t, std::size_t);

} // namespace bough::fast
