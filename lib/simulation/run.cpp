#include "run.h"
#include "../stages/expand.h"
#include "../stages/state_arrays.h"
#include <cmath>

namespace bough {
namespace {

template <class V> bool finite(const V& value) {
    if constexpr (std::is_floating_point_v<V>)
        return std::isfinite(value);
    else if constexpr (requires { value.allFinite(); })
        return value.allFinite();
    else
        return true; // a step's own scratch
}

std::string body_text(const Tree& tree, std::size_t i) {
    return "body " + std::to_string(i) + " (branch " + std::to_string(tree.branch[i]) + ")";
}

template <class T> std::string free_text(const World<T>& world, std::size_t k) {
    if (k < world.balls) return "ball " + std::to_string(k);
    return "what fell with " + body_text(*world.tree, std::size_t(world.free[k].parts.front().body));
}

// The stage before the spring that writes an array (state.h); visit_arrays names them in the order of the stages.
const char* early_stage(const std::string& array) {
    if (array.rfind("c_", 0) == 0) return stage_name(Stage::composite);
    if (array == "f_w" || array == "tau_w" || array.rfind("drag_", 0) == 0) return stage_name(Stage::external_forces);
    return nullptr;
}

template <class T> std::string stage_of(const Plan<T>& plan, const State<T>& state, const Tree& tree) {
    std::string place;
    visit_arrays(Plan<T>(), state, [&](const std::string& name, const auto& array, bool, const std::string&) {
        const char* stage = place.empty() ? early_stage(name) : nullptr;
        for (std::size_t i = 0; stage && place.empty() && i < array.size(); ++i)
            if (!finite(array[i])) place = std::string(stage) + " (" + name + "), " + body_text(tree, i);
    });
    const Stage last = is_articulated(plan.solver)      ? Stage::articulated
                       : plan.solver == Solver::coupled ? Stage::resolvent
                                                        : Stage::spring;
    if (place.empty()) place = std::string(stage_name(last)) + " (theta), " + body_text(tree, *first_non_finite(state));
    return "stage " + place;
}

// tree: const Tree& or Tree&&, as make_plan takes it.
template <class T, class TreeType>
Plan<T> plan_of(TreeType&& tree, const Assembly& assembly, Wishes wishes, const StepChoice& choice) {
    wishes.top = assembly.part.top;
    wishes.reach = assembly.part.reach;
    wishes.clocks = assembly.part.clocks;
    try {
        std::optional<fast::Target> simd = choice.simd;
        double sleep = choice.sleep;
        if (assembly.part.parts > 1) sleep = 0; // trees sleep by blocks, which those of a whole scene share
        if (assembly.part.moved) {              // as make_plan decides for the whole
            sleep = 0;
            if (choice.solver == Solver::analytic) simd.reset();
        }
        Plan<T> plan = make_plan<T>(std::forward<TreeType>(tree), assembly.ranges, assembly.scene, wishes, choice.dt,
                                    choice.solver, choice.scheme, simd, sleep);
        if (choice.tolerance) plan.tolerance = *choice.tolerance;
        return plan;
    } catch (const std::out_of_range& error) {
        throw SceneError(error.what());
    } catch (const std::domain_error& error) {
        throw SceneError(std::string(error.what()) +
                         (assembly.whole ? " (bodies counted without the rigid ones)" : ""));
    }
}

} // namespace

template <class T> Plan<T> plan_run(const Assembly& assembly, const Wishes& wishes, const StepChoice& choice) {
    return plan_of<T>(assembly.tree, assembly, wishes, choice);
}

template <class T> Plan<T> plan_run(Assembly&& assembly, const Wishes& wishes, const StepChoice& choice) {
    return plan_of<T>(std::move(assembly.tree), assembly, wishes, choice);
}

template <class T> Run<T> start_run(Plan<T> plan, const Assembly& assembly) {
    Run<T> run{std::move(plan), {}, {}};
    run.state = make_state(run.plan);
    try {
        run.world = make_world(run.plan, assembly.tree, assembly.ranges);
    } catch (const std::out_of_range& error) {
        throw SceneError(error.what());
    } catch (const std::domain_error& error) {
        throw SceneError(error.what());
    }
    return run;
}

template <class T> std::string advance_run(Run<T>& run, const Tree& tree, StageClock* clock) {
    advance(run.plan, run.state, run.world, clock);
    std::string place = non_finite(run.plan, run.state, tree);
    if (!place.empty()) return place;
    if (const std::optional<std::size_t> free = first_non_finite(run.world))
        return "stage contacts, " + free_text(run.world, *free);
    return {};
}

template <class T> std::string non_finite(const Plan<T>& plan, State<T>& state, const Tree& tree) {
    if (plan.lanes.on && state.lanes.finite) return {}; // seen by the step itself
    present(plan, state);
    return first_non_finite(state) ? stage_of(plan, state, tree) : std::string();
}

template <class T>
std::optional<std::size_t> fill_frame(const State<T>& state, const MotionFields& fields, MotionFrame& out) {
    std::optional<std::size_t> broken;
    const auto copy = [&](bool wanted, const std::vector<Vector3<T>>& from, std::vector<Vec3>& to) {
        if (!wanted) return;
        to.resize(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) {
            to[i] = from[i].template cast<double>();
            if (!broken && !to[i].allFinite()) broken = i;
        }
    };
    copy(fields.pose, state.x_w, out.position);
    copy(fields.velocity, state.v_w, out.velocity);
    copy(fields.velocity, state.omega_w, out.angular_velocity);
    copy(fields.torque, state.torque_j, out.torque);
    copy(fields.angles, state.theta, out.theta);
    copy(fields.angles, state.theta_dot, out.theta_dot);
    if (!fields.pose) return broken;
    out.rotation.resize(state.R_wb.size());
    for (std::size_t i = 0; i < state.R_wb.size(); ++i) {
        out.rotation[i] = Quat(Mat3(state.R_wb[i].template cast<double>())).normalized();
        if (out.rotation[i].w() < 0) out.rotation[i].coeffs() *= -1;
    }
    return broken;
}

template <class T> void show_all(const Assembly& assembly, const Run<T>& run, MotionFrame& frame) {
    if (assembly.whole) expand_frame(assembly.whole->places, assembly.whole->tree, run.plan, run.state, frame);
    place_free_bodies(run.world, frame);
}

std::string hash_text(std::uint64_t hash) {
    std::string text(16, '0');
    for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = "0123456789abcdef"[hash & 15];
    return text;
}

template Plan<float> plan_run(const Assembly&, const Wishes&, const StepChoice&);
template Plan<double> plan_run(const Assembly&, const Wishes&, const StepChoice&);
template Plan<float> plan_run(Assembly&&, const Wishes&, const StepChoice&);
template Plan<double> plan_run(Assembly&&, const Wishes&, const StepChoice&);
template Run<float> start_run(Plan<float>, const Assembly&);
template Run<double> start_run(Plan<double>, const Assembly&);
template std::string advance_run(Run<float>&, const Tree&, StageClock*);
template std::string advance_run(Run<double>&, const Tree&, StageClock*);
template std::string non_finite(const Plan<float>&, State<float>&, const Tree&);
template std::string non_finite(const Plan<double>&, State<double>&, const Tree&);
template std::optional<std::size_t> fill_frame(const State<float>&, const MotionFields&, MotionFrame&);
template std::optional<std::size_t> fill_frame(const State<double>&, const MotionFields&, MotionFrame&);
template void show_all(const Assembly&, const Run<float>&, MotionFrame&);
template void show_all(const Assembly&, const Run<double>&, MotionFrame&);

} // namespace bough
