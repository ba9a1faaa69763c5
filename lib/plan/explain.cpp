#include "explain.h"
#include "../laws/wind_field.h"
#include <string_view>

namespace bough {
namespace {

template <class T> std::string update_reason(const Plan<T>& plan) {
    const std::string velocities = !plan.velocity         ? "no output field velocity: no velocities"
                                   : plan.velocity_wished ? "velocities for output field velocity"
                                   : plan.wind            ? "velocities for /wind"
                                                          : "velocities for /fictitious";
    const char* const no_wind = plan.velocity || plan.wind ? "" : "no wind, ";
    return "every scene (poses; " + (no_wind + velocities) + ")" + moved_roots(plan);
}

// Poses, and what of bodies is read of them.
template <class T> void explain_poses(const Plan<T>& plan, PlanAccount& account) {
    const bool lanes = plan.stepper->in_lanes();
    account.stage(Stage::state_update, !lanes,
                  !plan.pose ? "nobody reads poses"
                  : lanes    ? "when poses are read" + moved_roots(plan)
                             : update_reason(plan));
    const char* const read = pose_reason(plan);
    const std::string velocity = !plan.velocity
                                     ? (plan.wind ? "no output field velocity" : "no wind, no output field velocity")
                                 : !plan.stepper->kind().reads_velocities ? "output field velocity"
                                 : plan.wind                              ? "/wind (drag)"
                                                                          : "/fictitious";
    const std::string torque = !plan.torque                    ? "no output field torque, no output field stress"
                               : plan.stress_of_moment.empty() ? "output field torque"
                                                               : "output field stress";
    const std::size_t vectors = plan.bodies * sizeof(Vector3<T>);
    account.array("theta", vectors, plan.pose, read);
    account.array("theta_dot", vectors, plan.pose, read);
    account.array("R_wb", plan.bodies * sizeof(Matrix3<T>), plan.pose, read);
    account.array("x_w", vectors, plan.pose, read);
    account.array("omega_w", vectors, plan.velocity, velocity);
    account.array("v_w", vectors, plan.velocity, velocity);
    account.array("torque_j", vectors, plan.torque, torque);
}

// What is loose, and what walks: the same beside any solver.
template <class T> void explain_free(const Plan<T>& plan, PlanAccount& account) {
    const Scene& scene = plan.scene;
    const bool free = scene.fracture || !scene.balls.empty();
    const std::string what = !free                                    ? "no balls, no fracture"
                             : !scene.balls.empty() && scene.fracture ? "/balls, /fracture"
                             : scene.fracture                         ? "/fracture (once something broke)"
                                                                      : "/balls";
    account.stage(Stage::free_flight, free, what);
    account.stage(Stage::contacts, free,
                  !free          ? what
                  : plan.contact ? what + ": trees and ground"
                                 : what + ": ground alone; nothing free meets trees");
    account.stage(Stage::fracture, scene.fracture.has_value(), scene.fracture ? "/fracture" : "no fracture");
    account.stage(Stage::walkers, !scene.walkers.empty(), scene.walkers.empty() ? "no walkers" : "/walkers");
}

} // namespace

template <class T> const char* pose_reason(const Plan<T>& plan) {
    return plan.pose ? "every scene" : "in lanes; no poses, velocities, torques, stresses asked for";
}

template <class T> std::string wind_parts(const Plan<T>& plan) {
    if (!plan.wind) return "";
    const Wind& wind = *plan.scene.wind;
    std::string parts;
    for (const std::string_view part : parts_over_ground(wind)) {
        parts += "; " + std::string(part);
        if (part != "/wind/grid") continue;
        parts += ", " + std::to_string(std::size_t(wind.grid->columns) * std::size_t(wind.grid->rows)) + " cells";
    }
    if (plan.clocks.size() > 1) parts += "; /trees' starts, " + std::to_string(plan.clocks.size()) + " clocks";
    return parts;
}

template <class T> std::string wind_reason(const Plan<T>& plan) {
    return plan.wind ? "/wind" + wind_parts(plan) : "no wind";
}

template <class T> std::string forces_reason(const Plan<T>& plan) {
    std::string text;
    const auto add = [&](bool on, const char* part) {
        if (on) text += (text.empty() ? "" : ", ") + std::string(part);
    };
    add(plan.wind, "/wind");
    add(plan.wind && plan.leaf.on, "/leaves");
    add(!plan.pulls.empty() || !plan.followers.empty(), "/pulls");
    add(plan.contact && !plan.scene.balls.empty(), "/balls");
    add(plan.contact && plan.scene.fracture.has_value(), "/fracture");
    add(!plan.scene.walkers.empty(), "/walkers");
    add(callers_forces(plan), "forces of the caller");
    return text.empty() ? "no wind, no pulls" : text;
}

template <class T> std::string moved_roots(const Plan<T>& plan) {
    return plan.root_motion ? "; roots moved by /root_motion" : "";
}

template <class T> std::string limited_angles(const Plan<T>& plan) {
    return plan.joint_limit ? "; angles kept within /joint_limit" : "";
}

template <class T> bool callers_forces(const Plan<T>& plan) {
    return plan.loads && !plan.contact && plan.scene.walkers.empty();
}

template <class T> PlanAccount explain(const Plan<T>& plan) {
    const StepperKind& kind = plan.stepper->kind();
    PlanAccount account;
    for (std::size_t k = 0; k < stage_count; ++k) account.stage(Stage(k), false, std::string("solver ") + kind.name);
    account.stage(Stage::lanes, false, "plain path: " + kind.plainly);
    explain_poses(plan, account);
    explain_free(plan, account);
    plan.stepper->explain(plan, account);
    return account;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template PlanAccount explain(const Plan<T>&);                                                                      \
    template const char* pose_reason(const Plan<T>&);                                                                  \
    template std::string wind_reason(const Plan<T>&);                                                                  \
    template std::string wind_parts(const Plan<T>&);                                                                   \
    template std::string forces_reason(const Plan<T>&);                                                                \
    template std::string moved_roots(const Plan<T>&);                                                                  \
    template std::string limited_angles(const Plan<T>&);                                                               \
    template bool callers_forces(const Plan<T>&);
#include "../base/instantiate.inc"

} // namespace bough
