#include "explain.h"
#include "../fast/plan_lanes.h"
#include "../model/shortest_text.h"
#include "state_arrays.h"

namespace bough {

const char* stage_name(Stage stage) {
    static constexpr const char* names[stage_count] = {
        "wind_field",   "external_forces", "composite", "drag",       "root_motion", "fictitious",
        "spring",       "articulated",     "midpoint",  "body_loads", "resolvent",   "lanes",
        "state_update", "free_flight",     "contacts",  "fracture",   "walkers"};
    return names[std::size_t(stage)];
}

const char* solver_name(Solver solver) {
    static constexpr const char* names[] = {"coupled", "analytic", "articulated-explicit", "articulated-implicit",
                                            "articulated-reference"};
    return names[std::size_t(solver)];
}

template <class T> std::string forces_text(const Plan<T>& plan) {
    std::string text;
    const auto add = [&](bool on, const char* part) {
        if (on) text += (text.empty() ? "" : ", ") + std::string(part);
    };
    add(plan.wind, "/wind");
    add(plan.wind && plan.leaf.on, "/leaves");
    add(!plan.pulls.empty(), "/pulls");
    add(plan.contact && !plan.scene.balls.empty(), "/balls");
    add(plan.contact && plan.scene.fracture.has_value(), "/fracture");
    add(!plan.scene.walkers.empty(), "/walkers");
    add(plan.loads && !plan.contact && plan.scene.walkers.empty(), "forces of the caller");
    return text.empty() ? "no wind, no pulls" : text;
}

template std::string forces_text(const Plan<float>&);
template std::string forces_text(const Plan<double>&);

namespace {

// What of a wind varies over the ground, as the plan says it.
std::string parts_of_field(const Wind& wind) {
    const auto text_of = [](std::size_t n, const char* what) { return std::to_string(n) + what; };
    std::string parts;
    if (wind.grid)
        parts += "; /wind/grid, " + text_of(std::size_t(wind.grid->columns) * std::size_t(wind.grid->rows), " cells");
    if (wind.swirl) parts += "; /wind/swirl";
    if (wind.shelter) parts += "; /wind/shelter";
    return parts;
}

// What varies from tree to tree.
std::string parts_of_clocks(const std::vector<double>& clocks) {
    return clocks.size() == 1 ? "" : "; /trees' starts, " + std::to_string(clocks.size()) + " clocks";
}

} // namespace

template <class T> void explain(Plan<T>& plan, const Wishes& wishes) {
    const auto add = [&plan](Stage stage, bool on, const std::string& reason) {
        plan.stages.push_back({stage, on, reason});
    };
    const bool analytic = plan.solver == Solver::analytic, coupled = plan.solver == Solver::coupled;
    const std::string solver = std::string("solver ") + solver_name(plan.solver);
    const std::string own = solver + " (evaluates it in its own pass)";
    const std::string field = plan.wind ? parts_of_field(*plan.scene.wind) + parts_of_clocks(plan.clocks) : "";
    const std::string moved = plan.root_motion ? "; roots moved by /root_motion" : "";
    const std::string limited = plan.joint_limit ? "; angles kept within /joint_limit" : "";
    const std::string forces = forces_text(plan);
    add(Stage::wind_field, (analytic || coupled) && plan.wind && !plan.lanes.on,
        !plan.wind            ? "no wind"
        : plan.lanes.on       ? "in lanes" + field
        : analytic || coupled ? "/wind" + field
                              : own + field);
    const std::string fused = "in lanes";
    const bool joints = analytic && !plan.lanes.on; // one by one, by the plain step
    const auto why = [&](const std::string& plainly, const std::string& other) {
        return joints ? plainly : analytic ? fused : other;
    };
    add(Stage::external_forces, joints && plan.forces, plan.forces ? why(forces, own) : forces);
    add(Stage::composite, joints, why("every scene", solver));
    add(Stage::drag, joints && plan.wind, plan.wind ? why("/wind", own) : "no wind");
    add(Stage::root_motion, joints && plan.root_motion, plan.root_motion ? why("/root_motion", own) : "no root motion");
    add(Stage::fictitious, plan.fictitious, plan.fictitious ? "/fictitious" : "no lagged fictitious terms");
    add(Stage::spring, joints,
        why(std::string("every scene") + (plan.root_motion ? "; the root's term for /root_motion" : "") + limited,
            solver));
    add(Stage::articulated, is_articulated(plan.solver), solver);
    const bool plain = coupled && !plan.lanes.on;
    add(Stage::midpoint, plain, plain ? "every scene" + moved : coupled ? fused : solver);
    add(Stage::body_loads, plain,
        plain     ? "every scene" + (plan.forces ? "; " + forces : "")
        : coupled ? fused
                  : solver);
    add(Stage::resolvent, plain, plain ? "every scene" + limited : coupled ? fused : solver);
    add(Stage::lanes, plan.lanes.on,
        plan.lanes.on
            ? std::string("SIMD ") + fast::target_name(plan.target) + (plan.forces ? "; " + forces : "") + moved +
                  (plan.lanes.sleep.on ? "; asleep below " + four_digits(plan.lanes.sleep.rate) + " rad/s"
                                       : "; no sleep: " + plan.lanes.sleep.reason)
            : "plain path: " + plan.lanes.reason);
    add(Stage::state_update, !plan.lanes.on,
        !plan.pose ? "nobody reads poses"
        : plan.lanes.on
            ? "when poses are read" + moved
            : std::string(!plan.velocity
                              ? (plan.wind ? "every scene (poses; no output field velocity: no velocities)"
                                           : "every scene (poses; no wind, no output field velocity: no velocities)")
                          : wishes.velocity ? "every scene (poses; velocities for output field velocity)"
                          : plan.wind       ? "every scene (poses; velocities for /wind)"
                                            : "every scene (poses; velocities for /fictitious)") +
                  (plan.fictitious ? "; accelerations for /fictitious" : "") + moved);
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
    State<T> empty;
    visit_arrays(plan, empty, [&](const char* name, auto& array, bool on, const std::string& reason) {
        plan.arrays.push_back({name, on, plan.bodies * sizeof(array[0]), reason});
    });
    if (plan.lanes.on) {
        const fast::Layout& layout = plan.lanes.layout;
        const auto rows = [&](const char* name, std::size_t count, int quantities) {
            plan.arrays.push_back(
                {name, true, count * std::size_t(quantities) * sizeof(fast::Row<T>), "the fast path"});
        };
        if (analytic) {
            constexpr int L = fast::Row<T>::lanes;
            const int inward = fast::analytic::inward_count(plan.wind, plan.pushes());
            rows("lanes.now", layout.rows, fast::analytic::motion::count);
            rows("lanes.outward, inward", layout.joints,
                 int(fast::record(fast::analytic::outward_count(plan.field), L) + fast::record(inward, L)) / L);
        } else {
            rows("lanes.table", layout.rows, fast::coupled_columns(fast::waits(layout), scheme_of(plan.scheme).poles));
            rows("lanes.outward, inward, accelerated", layout.joints, fast::records_of_joint<T>());
        }
    }
    plan.arrays.push_back(
        {"articulated", is_articulated(plan.solver),
         plan.bodies * sizeof(ArticulatedBody) * std::max<std::size_t>(1, articulated_passes(plan.solver)), solver});
}

template void explain(Plan<float>&, const Wishes&);
template void explain(Plan<double>&, const Wishes&);

} // namespace bough
