#include "simulation.h"
#include "exits.h"
#include "formats/open.h"
#include "lib/stages/state_arrays.h"
#include <cmath>

namespace bough {
namespace {

template <class T> bool finite(const T& value) {
    if constexpr (std::is_floating_point_v<T>)
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

template <class T>
[[noreturn]] void name_non_finite(const Plan<T>& plan, const State<T>& state, const Tree& tree, std::int64_t frame) {
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
    if (plan.solver == Solver::articulated_explicit)
        place += "; explicit Euler needs far smaller steps (--substeps), or take --solver articulated-implicit";
    throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) + ": stage " + place);
}

} // namespace

namespace {

// tree: const Tree& or Tree&&, as make_plan takes it.
template <class T, class TreeType>
Plan<T> plan_of(TreeType&& tree, const Setting& setting, Wishes wishes, const RunOptions& o) {
    wishes.top = setting.part.top;
    wishes.reach = setting.part.reach;
    wishes.clocks = setting.part.clocks;
    try {
        const Solver solver = chosen_solver(o);
        std::optional<fast::Target> simd = chosen_simd(o);
        double sleep = chosen_sleep(o);
        if (setting.part.parts > 1) sleep = 0; // trees sleep by blocks, which those of a whole scene share
        if (setting.part.moved) {              // as make_plan decides for the whole
            sleep = 0;
            if (solver == Solver::analytic) simd.reset();
        }
        Plan<T> plan = make_plan<T>(std::forward<TreeType>(tree), setting.ranges, setting.scene, wishes,
                                    1 / (o.fps * o.substeps), solver, chosen_scheme(o), simd, sleep);
        if (o.tolerance) plan.tolerance = *o.tolerance;
        return plan;
    } catch (const std::out_of_range& error) {
        throw InputError(input_name(o.input), error.what());
    } catch (const std::domain_error& error) {
        throw InputError(input_name(o.input),
                         std::string(error.what()) + (setting.whole ? " (bodies counted without the rigid ones)" : ""));
    }
}

} // namespace

template <class T> Plan<T> plan_run(const Setting& setting, const Wishes& wishes, const RunOptions& o) {
    return plan_of<T>(setting.tree, setting, wishes, o);
}

template <class T> Plan<T> plan_run(Setting&& setting, const Wishes& wishes, const RunOptions& o) {
    return plan_of<T>(std::move(setting.tree), setting, wishes, o);
}

template <class T> Run<T> start_run(Plan<T> plan, const Setting& setting, const RunOptions& o) {
    Run<T> run{std::move(plan), {}, {}};
    run.state = make_state(run.plan);
    try {
        run.world = make_world(run.plan, setting.tree, setting.ranges);
    } catch (const std::out_of_range& error) {
        throw InputError(input_name(o.input), error.what());
    } catch (const std::domain_error& error) {
        throw InputError(input_name(o.input), error.what());
    }
    return run;
}

template <class T>
void advance_frame(Run<T>& run, const Tree& tree, std::int64_t frame, int substeps, StageClock* clock) {
    for (int k = 0; k < substeps; ++k) {
        advance(run.plan, run.state, run.world, clock);
        require_finite(run.plan, run.state, tree, frame);
        if (const std::optional<std::size_t> free = first_non_finite(run.world))
            throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) +
                               ": stage contacts, " + free_text(run.world, *free));
    }
}

template <class T> void require_finite(const Plan<T>& plan, State<T>& state, const Tree& tree, std::int64_t frame) {
    if (plan.lanes.on && state.lanes.finite) return; // seen by the step itself
    present(plan, state);
    if (first_non_finite(state)) name_non_finite(plan, state, tree, frame);
}

template <class T>
void fill_frame(const State<T>& state, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame& out) {
    const auto copy = [&](bool wanted, const std::vector<Vector3<T>>& from, std::vector<Vec3>& to) {
        if (!wanted) return;
        to.resize(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) {
            to[i] = from[i].template cast<double>();
            if (!to[i].allFinite())
                throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) +
                                   ": stage state_update, body " + std::to_string(i));
        }
    };
    out.frame = frame;
    out.time = double(frame) / fps;
    copy(fields.pose, state.x_w, out.position);
    copy(fields.velocity, state.v_w, out.velocity);
    copy(fields.velocity, state.omega_w, out.angular_velocity);
    copy(fields.torque, state.torque_j, out.torque);
    copy(fields.angles, state.theta, out.theta);
    copy(fields.angles, state.theta_dot, out.theta_dot);
    if (!fields.pose) return;
    out.rotation.resize(state.R_wb.size());
    for (std::size_t i = 0; i < state.R_wb.size(); ++i) {
        out.rotation[i] = Quat(Mat3(state.R_wb[i].template cast<double>())).normalized();
        if (out.rotation[i].w() < 0) out.rotation[i].coeffs() *= -1;
    }
}

std::string hash_text(std::uint64_t hash) {
    std::string text(16, '0');
    for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = "0123456789abcdef"[hash & 15];
    return text;
}

template Plan<float> plan_run(const Setting&, const Wishes&, const RunOptions&);
template Plan<double> plan_run(const Setting&, const Wishes&, const RunOptions&);
template Plan<float> plan_run(Setting&&, const Wishes&, const RunOptions&);
template Plan<double> plan_run(Setting&&, const Wishes&, const RunOptions&);
template Run<float> start_run(Plan<float>, const Setting&, const RunOptions&);
template Run<double> start_run(Plan<double>, const Setting&, const RunOptions&);
template void advance_frame(Run<float>&, const Tree&, std::int64_t, int, StageClock*);
template void advance_frame(Run<double>&, const Tree&, std::int64_t, int, StageClock*);
template void require_finite(const Plan<float>&, State<float>&, const Tree&, std::int64_t);
template void require_finite(const Plan<double>&, State<double>&, const Tree&, std::int64_t);
template void fill_frame(const State<float>&, std::int64_t, double, const MotionFields&, MotionFrame&);
template void fill_frame(const State<double>&, std::int64_t, double, const MotionFields&, MotionFrame&);

} // namespace bough
