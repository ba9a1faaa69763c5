#include "plan_lanes.h"
#include "../coupled/own_inertia.h"
#include "../stages/wind.h"
#include "analytic_lanes_step.h"
#include "clear_lanes.h"
#include "lane_tables.h"
#include "shared_constants.h"
#include <algorithm>

namespace bough::fast {
namespace {

template <class T> void fill(const Plan<T>& plan, PlannedLanes<T>& lanes) {
    fill_constants(lanes, constant::count, put_pad<T>, [&](std::size_t i, const Slot<T>& row) {
        put_body(plan, i, row);
        row.put(constant::inertia_joint, own_inertia(plan.inertia_joint[i]));
        if (plan.gravity) row.put(constant::carried_moment, plan.carried_moment[i]);
        if (plan.wind) row.put(constant::drag_area, plan.drag_area[i]);
        if (plan.wind) row.put(constant::carried_drag, plan.carried_drag[i]);
    });
}

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
    rows.assign(layout.rows, Row<T>{});
    for (std::size_t i = 0; i < of_body.size(); ++i) {
        const std::size_t slot = layout.slot[i];
        rows[slot / Row<T>::lanes].lane[slot % Row<T>::lanes] = T(of_body[i]);
    }
}

template <class T> std::string reason_against(const Plan<T>& plan) {
    if (is_articulated(plan.solver)) return std::string("solver ") + solver_name(plan.solver);
    if (plan.joint_limit) return "/joint_limit";
    if (plan.solver == Solver::analytic)
        return plan.root_motion ? "/root_motion" : plan.fictitious ? "/fictitious" : "";
    const RationalScheme& scheme = scheme_of(plan.scheme);
    if (scheme.real) return std::string("scheme ") + scheme.name;
    return {};
}

} // namespace

template <class T> void plan_lanes(Plan<T>& plan, const std::vector<TreeRange>& ranges) {
    PlannedLanes<T>& lanes = plan.lanes;
    lanes.reason = reason_against(plan);
    lanes.on = lanes.reason.empty();
    if (!lanes.on) return;
    std::vector<std::uint32_t> ground; // of each root: 0, or 1 + its spline
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (plan.parent[i] < 0) ground.push_back(plan.root_motion ? std::uint32_t(spline_under(plan.moved, i) + 1) : 0);
    const std::vector<Kind> branches(plan.wind ? 0 : plan.bodies, Kind::branch); // without wind all are alike
    lanes.layout = make_layout(plan.parent, plan.wind ? plan.kind : branches, ground,
                               std::uint32_t(plan.splines.size() + 1), Row<T>::lanes);
    lanes.sharing.reason = reason_against_sharing(plan.scene, ranges);
    lanes.sharing.on = lanes.sharing.reason.empty();
    if (plan.solver == Solver::analytic)
        fill_analytic(plan, lanes);
    else
        fill(plan, lanes);
    fill_pulls(plan, lanes);
    if (!plan.wind) return;
    fill_of_bodies(lanes.layout, plan.shelter, lanes.shelter);
    fill_of_bodies(lanes.layout, plan.clock, lanes.clock);
    const WindTable<T> table = make_wind_table<T>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    lanes.profile = table.profile;
    lanes.per_metre = table.per_metre;
}

template void plan_lanes(Plan<float>&, const std::vector<TreeRange>&);
template void plan_lanes(Plan<double>&, const std::vector<TreeRange>&);

} // namespace bough::fast
