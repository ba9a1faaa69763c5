#include "plan_lanes.h"
#include "../laws/wind.h"
#include "lanes_stepper.h"
#include "shared_constants.h"
#include <algorithm>
#include <utility>

namespace bough::fast {
namespace {

template <class T> void fill_pulls(const Plan<T>& plan, PlannedLanes<T>& lanes) {
    if (plan.pulls.empty()) return;
    lanes.pull_of_row.assign(lanes.layout.rows, -1);
    for (std::size_t k = 0; k < plan.pulls.size(); ++k) lanes.pull.push_back(k);
    const auto slot = [&](std::size_t k) { return lanes.layout.slot[plan.pulls[k].body]; };
    std::stable_sort(lanes.pull.begin(), lanes.pull.end(),
                     [&](std::size_t a, std::size_t b) { return slot(a) < slot(b); });
    for (std::size_t k = lanes.pull.size(); k-- > 0;)
        lanes.pull_of_row[slot(lanes.pull[k]) / std::size_t(Row<T>::lanes)] = std::int32_t(k);
}

// A number of each body, or nothing.
template <class T, class Number>
void fill_of_bodies(const Layout& layout, const std::vector<Number>& of_body, RowVector<T>& rows) {
    if (of_body.empty()) return;
    set_zero_rows(rows, layout.rows);
    for (std::size_t i = 0; i < of_body.size(); ++i) {
        const std::size_t slot = layout.slot[i];
        rows[slot / Row<T>::lanes].lane[slot % Row<T>::lanes] = T(of_body[i]);
    }
}

} // namespace

template <class T>
void lay_out_lanes(const Plan<T>& plan, const std::vector<TreeRange>& ranges, PlannedLanes<T>& lanes) {
    std::vector<std::uint32_t> ground; // of each root: 0, or 1 + its spline
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (plan.parent[i] < 0) ground.push_back(plan.root_motion ? std::uint32_t(spline_under(plan.moved, i) + 1) : 0);
    const std::vector<Kind> branches(plan.wind ? 0 : plan.bodies, Kind::branch); // without wind all are alike
    lanes.layout = make_layout(plan.parent, plan.wind ? plan.kind : branches, ground,
                               std::uint32_t(plan.splines.size() + 1), Row<T>::lanes);
    lanes.sharing.reason = reason_against_sharing(plan.scene, ranges);
    lanes.sharing.on = lanes.sharing.reason.empty();
    fill_pulls(plan, lanes);
    if (!plan.wind) return;
    fill_of_bodies(lanes.layout, plan.shelter, lanes.shelter);
    fill_of_bodies(lanes.layout, plan.clock, lanes.clock);
    fill_of_bodies(lanes.layout, plan.facing, lanes.facing);
    const WindTable<T> table = make_wind_table<T>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    lanes.profile = table.profile;
    lanes.per_metre = table.per_metre;
}

template <class T> const PlannedLanes<T>* planned_lanes(const Plan<T>& plan) {
    const auto* stepper = dynamic_cast<const LanesStepper<T>*>(&*plan.stepper);
    return stepper ? &stepper->lanes() : nullptr;
}
template <class T> PlannedLanes<T>* planned_lanes(Plan<T>& plan) {
    return const_cast<PlannedLanes<T>*>(planned_lanes(std::as_const(plan))); // the plan is the caller's to change
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void lay_out_lanes(const Plan<T>&, const std::vector<TreeRange>&, PlannedLanes<T>&);                      \
    template const PlannedLanes<T>* planned_lanes(const Plan<T>&);                                                     \
    template PlannedLanes<T>* planned_lanes(Plan<T>&);
#include "../base/instantiate.inc"

} // namespace bough::fast
