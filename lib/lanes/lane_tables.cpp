#include "lane_tables.h"
#include "../base/parallel.h"
#include "../laws/wind.h"
#include "../plan/pushes.h"
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

template <class T> PullOnLane<T> on_lane(const PlannedLanes<T>& planned, std::size_t body, const Vector3<T>& point_b) {
    const std::size_t slot = planned.layout.slot[body];
    PullOnLane<T> pull{std::uint32_t(slot / Row<T>::lanes), std::uint32_t(slot % Row<T>::lanes), {}, {}, {}, no_source};
    for (int j = 0; j < 3; ++j) pull.point[j] = point_b[j];
    return pull;
}

// The pulls and the loads of this step, rising by row; what stands of the last step's loads goes.
template <class T> void place_loads(const PlannedLanes<T>& planned, const State<T>& state, Lanes<T>& lanes) {
    const std::size_t before = lanes.pulls.size();
    std::erase_if(lanes.pulls, [&](const PullOnLane<T>& pull) {
        lanes.pull_of_row[pull.row] = -1;
        return pull.source == no_source;
    });
    if (before == 0 && state.loads.empty()) return;
    for (const Load<T>& load : state.loads) {
        PullOnLane<T> pull = on_lane(planned, load.body, load.point_b);
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

template <class T> void pack_pulls(const Plan<T>& plan, const PlannedLanes<T>& planned, Lanes<T>& lanes) {
    lanes.pulls.clear();
    for (std::size_t k : planned.pull) {
        PullOnLane<T> pull = on_lane(planned, plan.pulls[k].body, plan.pulls[k].point_b);
        pull.source = plan.pulls[k].source;
        lanes.pulls.push_back(pull);
    }
    if (!plan.loads) return;
    lanes.pull_of_row = planned.pull_of_row;
    lanes.pull_of_row.resize(planned.layout.rows, -1);
}

namespace {

template <class T>
void place_field(const Plan<T>& plan, const PlannedLanes<T>& planned, State<T>& state, double middle,
                 FieldRows<T>& rows) {
    evaluate_wind(*plan.scene.wind, middle, state.wind);
    const WindField<T>& field = state.wind.field;
    rows.middle = tables_of(field);
    rows.shape = field.shape;
    rows.all_cells = std::int32_t(field.velocity.size() / 3);
    rows.all_rings = std::int32_t(field.turn.size() / 2);
    rows.shelter = planned.shelter.empty() ? nullptr : planned.shelter.front().lane;
    rows.clock = planned.clock.empty() ? nullptr : planned.clock.front().lane;
}

} // namespace

template <class T> SweepLoads sweep_loads(const Plan<T>& plan) {
    return {plan.wind, plan.pushes(), plan.gravity, plan.field};
}

template <class T>
void place_tables(const Plan<T>& plan, const PlannedLanes<T>& planned, State<T>& state, Lanes<T>& lanes, double middle,
                  SweepRows<T>& rows) {
    const Layout& layout = planned.layout;
    rows.groups = layout.groups.data();
    rows.base = layout.base.data();
    rows.landing = layout.landing.data();
    rows.fork = layout.fork.data();
    rows.fork_of_row = layout.fork_of_row.data();
    rows.constants = planned.constants.front().lane;
    rows.constants_row = planned.sharing.on ? planned.sharing.row.data() : nullptr;
    rows.outward_records = data(lanes.outward);
    rows.inward_records = data(lanes.inward);
    rows.h = T(plan.dt);
    put(rows.gravity, plan.scene.gravity);
    if (plan.wind) {
        if (plan.field)
            place_field(plan, planned, state, middle, rows.field);
        else
            put(rows.wind, wind_velocity(*plan.scene.wind, middle));
        rows.profile = planned.profile.data();
        rows.profile_entries = planned.profile.size();
        rows.per_metre = planned.per_metre;
        rows.leaf = plan.leaf;
        rows.facing = planned.facing.empty() ? nullptr : planned.facing.front().lane;
    }
    if (plan.loads) place_loads(planned, state, lanes);
    if (lanes.pulls.empty()) return;
    rows.pull_of_row = plan.loads ? lanes.pull_of_row.data() : planned.pull_of_row.data();
    rows.pulls = lanes.pulls.data();
    rows.pull_count = lanes.pulls.size();
    for (PullOnLane<T>& pull : lanes.pulls)
        if (pull.source != no_source) put(pull.force, pull_force(plan.scene.pulls[pull.source], middle));
}

template <class T> void add_ports(const PlannedLanes<T>& planned, Lanes<T>& lanes, int count) {
    const std::vector<Port>& ports = planned.layout.ports;
    for (std::size_t p = 0; p < ports.size(); ++p) {
        const bool stands = planned.sleep.on && rest_of(lanes, planned.sleep.block_of_port[p]) != Rest::awake;
        for (int k = 0; k < count; ++k) {
            T& part = entry(lanes.inward, ports[p].joint, count, k);
            entry(lanes.inward, ports[p].fork, count, k) += part;
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

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void put_body(const Plan<T>&, std::size_t, const Slot<T>&);                                               \
    template void resize_records(const Layout&, RowVector<T>&, int);                                                   \
    template void pack_pulls(const Plan<T>&, const PlannedLanes<T>&, Lanes<T>&);                                       \
    template SweepLoads sweep_loads(const Plan<T>&);                                                                   \
    template void place_tables(const Plan<T>&, const PlannedLanes<T>&, State<T>&, Lanes<T>&, double, SweepRows<T>&);   \
    template void add_ports(const PlannedLanes<T>&, Lanes<T>&, int);                                                   \
    template void share_scratch(const Layout&, Lanes<T>&, std::size_t, std::size_t);
#include "../base/instantiate.inc"

} // namespace bough::fast
