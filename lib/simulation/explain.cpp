#include "explain.h"
#include "../analytic/analytic_lanes_stepper.h"
#include "../analytic/analytic_rows.h"
#include "../analytic/analytic_stepper.h"
#include "../analytic/held_points.h"
#include "../base/shortest_text.h"
#include "../coupled/attachment.h"
#include "../coupled/attachment_lanes.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../coupled/coupled_places.h"
#include "../lanes/plan_lanes.h"
#include "../laws/wind_field.h"
#include <string_view>

namespace bough {

namespace {

// How the steps are made, as far as the account tells of it.
template <class T> struct Way {
    std::string solver; // "solver coupled"
    bool analytic, coupled, fictitious;
    const fast::PlannedLanes<T>* lanes; // null: the plain path
    bool real = false;                  // a scheme of a real pole
    int poles = 1;

    explicit Way(const Plan<T>& plan)
        : solver(std::string("solver ") + plan.stepper->kind().name), analytic(solver == "solver analytic"),
          coupled(solver == "solver coupled"), lanes(fast::planned_lanes(plan)) {
        const auto* joints = dynamic_cast<const AnalyticStepper<T>*>(&*plan.stepper);
        fictitious = joints && joints->own.fictitious;
        for (const Scheme scheme : all_schemes)
            if (coupled && std::string_view(plan.stepper->kind().scheme) == scheme_of(scheme).name) {
                real = scheme_of(scheme).real;
                poles = scheme_of(scheme).poles;
            }
    }
};

template <class T> bool pulls(const Plan<T>& plan) {
    return !plan.pulls.empty() || !plan.followers.empty();
}

// Are forces to come from the caller alone?
template <class T> bool callers(const Plan<T>& plan) {
    return plan.loads && !plan.contact && plan.scene.walkers.empty();
}

constexpr const char* no_points = "no attachments, no pulls";

// What holds or pushes points of bodies, placed one by one; empty: nothing does.
template <class T> std::string points_text(const Plan<T>& plan, bool coupled) {
    std::string text;
    const auto add = [&](bool on, const char* part) {
        if (on) text += (text.empty() ? "" : ", ") + std::string(part);
    };
    add(!plan.attachments.empty(), "/attachments");
    add(coupled && pulls(plan), "/pulls");
    add(coupled && callers(plan), "forces of the caller");
    return text;
}

// What loads the bodies: the parts of the scene that do, or that none does.
template <class T> std::string forces_text(const Plan<T>& plan) {
    std::string text;
    const auto add = [&](bool on, const char* part) {
        if (on) text += (text.empty() ? "" : ", ") + std::string(part);
    };
    add(plan.wind, plan.facing.empty() ? "/wind" : "/wind (clumps' leaves face one way: leaf_facing)");
    add(plan.wind && plan.leaf.on, "/leaves");
    add(pulls(plan), "/pulls");
    add(plan.contact && !plan.scene.balls.empty(), "/balls");
    add(plan.contact && plan.scene.fracture.has_value(), "/fracture");
    add(!plan.scene.walkers.empty(), "/walkers");
    add(callers(plan), "forces of the caller");
    return text.empty() ? "no wind, no pulls" : text;
}

// What of a wind varies over the ground, as the plan says it.
std::string parts_of_field(const Wind& wind) {
    std::string parts;
    for (const std::string_view part : parts_over_ground(wind)) {
        parts += "; " + std::string(part);
        if (part != "/wind/grid") continue;
        parts += ", " + std::to_string(std::size_t(wind.grid->columns) * std::size_t(wind.grid->rows)) + " cells";
    }
    return parts;
}

// What varies from tree to tree.
std::string parts_of_clocks(const std::vector<double>& clocks) {
    return clocks.size() == 1 ? "" : "; /trees' starts, " + std::to_string(clocks.size()) + " clocks";
}

template <class T> void explain_stages(const Plan<T>& plan, const Way<T>& way, std::vector<PlannedStage>& stages) {
    const auto add = [&stages](Stage stage, bool on, const std::string& reason) {
        stages.push_back({stage, on, reason});
    };
    const bool analytic = way.analytic, coupled = way.coupled, lanes = way.lanes != nullptr;
    const std::string& solver = way.solver;
    const std::string own = solver + " (evaluates it in its own pass)";
    const std::string field = plan.wind ? parts_of_field(*plan.scene.wind) + parts_of_clocks(plan.clocks) : "";
    const std::string moved = plan.root_motion ? "; roots moved by /root_motion" : "";
    const std::string limited = plan.joint_limit ? "; angles kept within /joint_limit" : "";
    const std::string forces = forces_text(plan);
    add(Stage::wind_field, (analytic || coupled) && plan.wind && !lanes,
        !plan.wind            ? "no wind"
        : lanes               ? "in lanes" + field
        : analytic || coupled ? "/wind" + field
                              : own + field);
    const std::string fused = "in lanes";
    const bool joints = analytic && !lanes; // one by one, by the plain step
    const auto why = [&](const std::string& plainly, const std::string& other) {
        return joints ? plainly : analytic ? fused : other;
    };
    add(Stage::external_forces, joints && plan.forces, plan.forces ? why(forces, own) : forces);
    add(Stage::composite, joints, why("every scene", solver));
    add(Stage::drag, joints && plan.wind, plan.wind ? why("/wind", own) : "no wind");
    add(Stage::root_motion, joints && plan.root_motion, plan.root_motion ? why("/root_motion", own) : "no root motion");
    add(Stage::fictitious, way.fictitious, way.fictitious ? "/fictitious" : "no lagged fictitious terms");
    add(Stage::spring, joints,
        why(std::string("every scene") + (plan.root_motion ? "; the root's term for /root_motion" : "") + limited,
            solver));
    add(Stage::articulated, !analytic && !coupled, solver);
    const bool plain = coupled && !lanes;
    add(Stage::midpoint, plain, plain ? "every scene" + moved : coupled ? fused : solver);
    add(Stage::body_loads, plain,
        plain     ? "every scene" + (plan.forces ? "; " + forces : "")
        : coupled ? fused
                  : solver);
    const std::string held = points_text(plan, coupled);
    add(Stage::attachments, !held.empty(), held.empty() ? no_points : held);
    add(Stage::resolvent, plain, plain ? "every scene" + limited : coupled ? fused : solver);
    add(Stage::lanes, lanes,
        lanes
            ? std::string("SIMD ") + fast::target_name(way.lanes->target) + (plan.forces ? "; " + forces : "") + moved +
                  (way.lanes->sleep.on ? "; asleep below " + four_digits(way.lanes->sleep.rate) + " rad/s"
                                       : "; no sleep: " + way.lanes->sleep.reason)
            : "plain path: " + plan.stepper->kind().plainly);
    add(Stage::state_update, !lanes,
        !plan.pose ? "nobody reads poses"
        : lanes
            ? "when poses are read" + moved
            : std::string(!plan.velocity
                              ? (plan.wind ? "every scene (poses; no output field velocity: no velocities)"
                                           : "every scene (poses; no wind, no output field velocity: no velocities)")
                          : plan.velocity_wished ? "every scene (poses; velocities for output field velocity)"
                          : plan.wind            ? "every scene (poses; velocities for /wind)"
                                                 : "every scene (poses; velocities for /fictitious)") +
                  (way.fictitious ? "; accelerations for /fictitious" : "") + moved);
    const Scene& scene = plan.scene;
    const bool free = scene.fracture || !scene.balls.empty();
    const std::string what = !scene.balls.empty() && scene.fracture ? "/balls, /fracture"
                             : scene.fracture                       ? "/fracture (once something broke)"
                                                                    : "/balls";
    add(Stage::free_flight, free, free ? what : "no balls, no fracture");
    add(Stage::contacts, free,
        !free          ? "no balls, no fracture"
        : plan.contact ? what + ": trees and ground"
                       : what + ": ground alone; nothing free meets trees");
    add(Stage::fracture, scene.fracture.has_value(), scene.fracture ? "/fracture" : "no fracture");
    add(Stage::walkers, !scene.walkers.empty(), scene.walkers.empty() ? "no walkers" : "/walkers");
}

// Of a state of the coupled solver: what attachments and pulled points take in it.
template <class T> std::size_t attached_bytes(const Plan<T>& plan) {
    fast::CoupledLanesState<T> work;
    work.ground.resize(plan.splines.size());
    begin_attachments(plan, work);
    const auto* in_lanes = dynamic_cast<const fast::CoupledLanesStepper<T>*>(&*plan.stepper);
    if (in_lanes && work.attachments.any()) fast::place_attached_rows(in_lanes->own, work);
    return work.attachments.bytes() + work.attached.bytes();
}

template <class T> void explain_arrays(const Plan<T>& plan, const Way<T>& way, std::vector<PlannedArray>& arrays) {
    const auto add = [&](const char* name, std::size_t size, bool on, const std::string& reason) {
        arrays.push_back({name, on, plan.bodies * size, reason});
    };
    const std::string always = "every scene", &solver = way.solver;
    const bool analytic = way.analytic, coupled = way.coupled, lanes = way.lanes != nullptr;
    const std::string fast = "the fast path";
    const std::string composite = !analytic ? solver : lanes ? fast : always, pass = coupled ? always : solver;
    const bool real = way.real, plain = coupled && !lanes;
    const std::string work = coupled && lanes ? fast : pass;
    const bool joints = analytic && !lanes; // one by one, by the plain step
    const bool air = joints && plan.wind, loads = joints && plan.forces;
    const std::string wind = !plan.wind ? "no wind" : air ? "/wind" : analytic ? fast : solver;
    const std::string forces = plan.forces && !analytic ? solver : plan.forces && !joints ? fast : forces_text(plan);
    const std::string lagged = way.fictitious ? "/fictitious" : "no lagged fictitious terms";
    const std::string velocity = air              ? "/wind (drag)"
                                 : way.fictitious ? "/fictitious"
                                 : plan.velocity  ? "output field velocity"
                                                  : "no wind, no output field velocity";
    const std::string torque = !plan.torque                    ? "no output field torque, no output field stress"
                               : plan.stress_of_moment.empty() ? "output field torque"
                                                               : "output field stress";
    const std::string unread = "in lanes; no poses, velocities, torques, stresses asked for";
    const std::string read = plan.pose ? always : unread;
    add("theta", sizeof(Vector3<T>), plan.pose, read);
    add("theta_dot", sizeof(Vector3<T>), plan.pose, read);
    add("scaled_rate", sizeof(Vector3<T>), !coupled && plan.pose, coupled ? solver : read);
    add("theta_change", sizeof(Vector3<T>), coupled && plan.pose, coupled ? read : pass);
    add("theta_dot_change", sizeof(Vector3<T>), coupled && plan.pose, coupled ? read : pass);
    add("R_wb", sizeof(Matrix3<T>), plan.pose, read);
    add("x_w", sizeof(Vector3<T>), plan.pose, read);
    add("omega_w", sizeof(Vector3<T>), plan.velocity, velocity);
    add("v_w", sizeof(Vector3<T>), plan.velocity, velocity);
    add("f_w", sizeof(Vector3<T>), loads, forces);
    add("tau_w", sizeof(Vector3<T>), loads, forces);
    add("drag_f_w", sizeof(Vector3<T>), air, wind);
    add("drag_tau_w", sizeof(Vector3<T>), air, wind);
    add("drag_bound", sizeof(T), air, wind);
    add("wind_bound", sizeof(T), air, wind);
    add("turn_bound", sizeof(T), air, wind);
    add("c_h_w", sizeof(Vector3<T>), joints, composite);
    add("c_J_w", sizeof(Matrix3<T>), joints, composite);
    add("c_f_w", sizeof(Vector3<T>), loads, forces);
    add("c_tau_w", sizeof(Vector3<T>), loads, forces);
    add("c_drag_f_w", sizeof(Vector3<T>), air, wind);
    add("c_drag_tau_w", sizeof(Vector3<T>), air, wind);
    add("c_drag", sizeof(T), air, wind);
    add("c_drag_row", sizeof(T), air, wind);
    add("c_wind", sizeof(T), air, wind);
    add("c_wind_row", sizeof(T), air, wind);
    add("c_turn", sizeof(T), air, wind);
    add("c_turn_row", sizeof(T), air, wind);
    add("spin_dot", sizeof(Vector3<T>), way.fictitious, lagged);
    add("alpha_w", sizeof(Vector3<T>), way.fictitious, lagged);
    add("a_w", sizeof(Vector3<T>), way.fictitious, lagged);
    add("fictitious_w", sizeof(Vector3<T>), way.fictitious, lagged);
    const bool held = !coupled && !plan.attachments.empty();
    const std::string points = coupled ? solver : held ? "/attachments" : "no attachments";
    add("held_tau_w", sizeof(Vector3<T>), held, points);
    add("held_row", sizeof(T), held, points);
    arrays.push_back({"held", held, held ? planned_held(plan).bytes() : 0, points});
    const std::size_t attached = coupled ? attached_bytes(plan) : 0;
    const std::string placed = points_text(plan, coupled);
    arrays.push_back({"attachments", attached > 0, attached,
                      !coupled         ? solver
                      : attached > 0   ? placed
                      : placed.empty() ? no_points
                                       : placed + ", once there are some"});
    add("coupled", sizeof(CoupledBody<T>), plain, work);
    add("resolvent", sizeof(ResolventBody<std::complex<T>>), plain && !real,
        coupled && real ? "a scheme of a real pole" : work);
    add("resolvent_real", sizeof(ResolventBody<T>), coupled && (real || plan.joint_limit),
        !coupled           ? solver
        : real             ? pass
        : plan.joint_limit ? "/joint_limit"
                           : "a scheme of complex poles, no joint limit");
    add("guard", sizeof(GuardBody<T>), plain, work);
    add("torque_j", sizeof(Vector3<T>), plan.torque, torque);
}

template <class T> void explain_rows(const Plan<T>& plan, const Way<T>& way, std::vector<PlannedArray>& arrays) {
    const fast::Layout& layout = way.lanes->layout;
    const auto rows = [&](const char* name, std::size_t count, int quantities) {
        arrays.push_back({name, true, count * std::size_t(quantities) * sizeof(fast::Row<T>), "the fast path"});
    };
    if (way.analytic) {
        constexpr int L = fast::Row<T>::lanes;
        const int inward = fast::analytic::inward_count(plan.wind, plan.pushes());
        rows("lanes.now", layout.rows, fast::analytic::motion::count);
        rows("lanes.outward, inward", layout.joints,
             int(fast::record(fast::analytic::outward_count(plan.field), L) + fast::record(inward, L)) / L);
    } else {
        rows("lanes.table", layout.rows, fast::coupled_columns(fast::waits(layout), way.poles));
        rows("lanes.outward, inward, accelerated", layout.joints, fast::records_of_joint<T>());
    }
}

} // namespace

template <class T> PlanAccount explain(const Plan<T>& plan) {
    const Way<T> way(plan);
    PlanAccount account;
    explain_stages(plan, way, account.stages);
    explain_arrays(plan, way, account.arrays);
    if (way.lanes) explain_rows(plan, way, account.arrays);
    if (const std::size_t bytes = plan.stepper->kind().pass_bytes; bytes > 0)
        account.arrays.push_back({"articulated", true, plan.bodies * bytes, way.solver});
    return account;
}

template PlanAccount explain(const Plan<float>&);
template PlanAccount explain(const Plan<double>&);

} // namespace bough
