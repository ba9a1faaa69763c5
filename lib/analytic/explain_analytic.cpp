#include "../lanes/explain_lanes.h"
#include "../plan/explain.h"
#include "analytic_lanes_stepper.h"
#include "analytic_rows.h"
#include "analytic_stepper.h"
#include "held_points.h"

namespace bough {
namespace {

template <class T> std::string why(const Plan<T>& plan, bool lagged, AnalyticNeed need) {
    switch (need) {
    case AnalyticNeed::forces:
        return forces_reason(plan);
    case AnalyticNeed::air:
        return plan.wind ? "/wind" : "no wind";
    case AnalyticNeed::lagged:
        return lagged ? "/fictitious" : "no lagged fictitious terms";
    case AnalyticNeed::held:
        return plan.attachments.empty() ? "no attachments" : "/attachments";
    case AnalyticNeed::always:
        break;
    }
    return "every scene";
}

} // namespace

template <class T> void AnalyticStepper<T>::explain(const Plan<T>& plan, PlanAccount& account) const {
    const auto part = [&](Stage stage, AnalyticNeed need) {
        account.stage(stage, needs_array(plan, own.fictitious, need), why(plan, own.fictitious, need));
    };
    account.stage(Stage::wind_field, plan.wind, wind_reason(plan));
    part(Stage::external_forces, AnalyticNeed::forces);
    part(Stage::composite, AnalyticNeed::always);
    part(Stage::drag, AnalyticNeed::air);
    account.stage(Stage::root_motion, plan.root_motion, plan.root_motion ? "/root_motion" : "no root motion");
    part(Stage::fictitious, AnalyticNeed::lagged);
    const char* const root = plan.root_motion ? "; the root's term for /root_motion" : "";
    account.stage(Stage::spring, true, "every scene" + (root + limited_angles(plan)));
    part(Stage::attachments, AnalyticNeed::held);
    if (own.fictitious) account.stages[std::size_t(Stage::state_update)].reason += "; accelerations for /fictitious";

    account.array("scaled_rate", plan.bodies * sizeof(Vector3<T>), true, "every scene");
    const AnalyticWork<T> none;
    visit_arrays(none, [&](const char* name, const auto& array, AnalyticNeed need) {
        account.array(name, plan.bodies * sizeof(array[0]), needs_array(plan, own.fictitious, need),
                      why(plan, own.fictitious, need));
    });
    const bool held = needs_array(plan, own.fictitious, AnalyticNeed::held);
    account.array("held", held ? planned_held(plan).bytes() : 0, held, why(plan, own.fictitious, AnalyticNeed::held));
}

template <class T> void fast::AnalyticLanesStepper<T>::explain(const Plan<T>& plan, PlanAccount& account) const {
    explain_lanes(plan, own.lanes, {Stage::composite, Stage::spring}, account);
    account.stage(Stage::external_forces, false, plan.forces ? in_lanes : forces_reason(plan));
    account.stage(Stage::drag, false, plan.wind ? in_lanes : "no wind");
    // Scenes with these are stepped plainly (analytic_stepper).
    account.stage(Stage::root_motion, false, "no root motion");
    account.stage(Stage::fictitious, false, why(plan, false, AnalyticNeed::lagged));
    account.stage(Stage::attachments, false, why(plan, false, AnalyticNeed::held));
    account.array("scaled_rate", plan.bodies * sizeof(Vector3<T>), plan.pose, pose_reason(plan));
    constexpr std::size_t L = Row<T>::lanes;
    const Layout& layout = own.lanes.layout;
    const std::size_t numbers =
        record(analytic::outward_count(plan.field), L) + record(analytic::inward_count(plan.wind, plan.pushes()), L);
    account.array("lanes.now", layout.rows * analytic::motion::count * sizeof(Row<T>), true, in_lanes);
    account.array("lanes.outward, inward", layout.joints * numbers / L * sizeof(Row<T>), true, in_lanes);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void AnalyticStepper<T>::explain(const Plan<T>&, PlanAccount&) const;                                     \
    template void fast::AnalyticLanesStepper<T>::explain(const Plan<T>&, PlanAccount&) const;
#include "../base/instantiate.inc"

} // namespace bough
