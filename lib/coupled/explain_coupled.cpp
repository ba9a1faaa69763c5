#include "../lanes/explain_lanes.h"
#include "../plan/explain.h"
#include "attachment.h"
#include "attachment_lanes.h"
#include "coupled_lanes_stepper.h"
#include "coupled_places.h"
#include "coupled_stepper.h"
#include <complex>

namespace bough {
namespace {

// What either way of making steps holds: the changes it carries, and what attachments and pulled points take (attached [B]).
template <class T> void explain_coupled(const Plan<T>& plan, std::size_t attached, PlanAccount& account) {
    std::string points; // that are held or pushed, and so placed one by one
    const auto add = [&](bool on, const char* part) {
        if (on) points += (points.empty() ? "" : ", ") + std::string(part);
    };
    add(!plan.attachments.empty(), "/attachments");
    add(!plan.pulls.empty() || !plan.followers.empty(), "/pulls");
    add(callers_forces(plan), "forces of the caller");
    const bool some = !points.empty();
    account.stage(Stage::attachments, some, some ? points : "no attachments, no pulls");
    account.array("attachments", attached, attached > 0,
                  !some          ? "no attachments, no pulls"
                  : attached > 0 ? points
                                 : points + ", once there are some");
    for (const char* name : {"theta_change", "theta_dot_change"})
        account.array(name, plan.bodies * sizeof(Vector3<T>), plan.pose, pose_reason(plan));
}

} // namespace

template <class T> void CoupledStepper<T>::explain(const Plan<T>& plan, PlanAccount& account) const {
    account.stage(Stage::wind_field, plan.wind, wind_reason(plan));
    account.stage(Stage::midpoint, true, "every scene" + moved_roots(plan));
    account.stage(Stage::body_loads, true, "every scene" + (plan.forces ? "; " + forces_reason(plan) : ""));
    account.stage(Stage::resolvent, true, "every scene" + limited_angles(plan));
    CoupledWork<T> work;
    work.ground.resize(plan.splines.size());
    begin_attachments(plan, work);
    explain_coupled(plan, work.attachments.bytes(), account);
    const bool real = scheme_of(own.scheme).real;
    account.array("coupled", plan.bodies * sizeof(CoupledBody<T>), true, "every scene");
    account.array("resolvent", plan.bodies * sizeof(ResolventBody<std::complex<T>>), !real,
                  real ? "a scheme of a real pole" : "every scene");
    account.array("resolvent_real", plan.bodies * sizeof(ResolventBody<T>), real || plan.joint_limit,
                  real               ? "every scene"
                  : plan.joint_limit ? "/joint_limit"
                                     : "a scheme of complex poles, no joint limit");
    account.array("guard", plan.bodies * sizeof(GuardBody<T>), true, "every scene");
}

template <class T> void fast::CoupledLanesStepper<T>::explain(const Plan<T>& plan, PlanAccount& account) const {
    explain_lanes(plan, own.lanes, {Stage::midpoint, Stage::body_loads, Stage::resolvent}, account);
    CoupledLanesState<T> work;
    work.ground.resize(plan.splines.size());
    begin_attachments(plan, work);
    if (work.attachments.any()) place_attached_rows(own, work);
    explain_coupled(plan, work.attachments.bytes() + work.attached.bytes(), account);
    const Layout& layout = own.lanes.layout;
    const auto rows = [](std::size_t count, int quantities) {
        return count * std::size_t(quantities) * sizeof(Row<T>);
    };
    account.array("lanes.table", rows(layout.rows, coupled_columns(waits(layout), scheme_of(own.scheme).poles)), true,
                  in_lanes);
    account.array("lanes.outward, inward, accelerated", rows(layout.joints, records_of_joint<T>()), true, in_lanes);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void CoupledStepper<T>::explain(const Plan<T>&, PlanAccount&) const;                                      \
    template void fast::CoupledLanesStepper<T>::explain(const Plan<T>&, PlanAccount&) const;
#include "../base/instantiate.inc"

} // namespace bough
