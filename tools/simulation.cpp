#include "simulation.h"
#include "exits.h"
#include "formats/documents/motion.h"
#include "formats/open.h"
#include "lib/simulation/run_choice.h"
#include "lib/study/timed_steps.h"
#include <cmath>
#include <utility>

namespace bough {
namespace {

// What the library refuses is told of as the input's.
[[noreturn]] void throw_as_input(const SceneError& error, const RunOptions& o) {
    const std::string what = error.what(), file = wind_file(o.wind), wind = "/wind/";
    if (!file.empty() && what.compare(0, wind.size(), wind) == 0) // it stands there without that folder
        throw InputError(input_name(file), what.substr(wind.size() - 1));
    throw InputError(input_name(o.input), what);
}

[[noreturn]] void fail_non_finite(const Simulation& run, std::int64_t frame, const std::string& place) {
    std::string advice;
    if (run.account().solver == solver_name(Solver::articulated_explicit))
        advice = "; explicit Euler needs far smaller steps (--substeps), or take --solver articulated-implicit";
    throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) + ": " + place + advice);
}

} // namespace

double step_length(const RunOptions& o) {
    return 1 / (o.fps * o.substeps);
}

Simulation started(const std::shared_ptr<Setting>& setting, const RunOptions& o, int threads, const RunWishes& wishes) {
    RunChoice choice;
    choice.options.step = step_length(o);
    choice.options.precision = o.precision == "float" ? Precision::single : Precision::double_;
    choice.options.threads = threads;
    choice.options.velocities = wishes.fields.velocity;
    choice.options.torques = wishes.fields.torque;
    choice.options.stresses = wishes.fields.stress;
    choice.steppers = stepper_maker(
        {chosen_solver(o), chosen_scheme(o), chosen_simd(o), chosen_sleep(o), o.tolerance.value_or(1e-8)});
    choice.poses = wishes.poses;
    choice.saves = wishes.state;
    choice.keeps_trees = wishes.trees;
    try {
        return make_simulation(setting, choice);
    } catch (const SceneError& error) {
        throw_as_input(error, o);
    }
}

void advance_frame(Simulation& simulation, std::int64_t frame, int substeps) {
    const StepReport report = simulation.step(substeps);
    if (!report.finite()) fail_non_finite(simulation, frame, report.non_finite);
}

void require_finite(Simulation& run, std::int64_t frame) {
    if (const std::string place = non_finite(run); !place.empty()) fail_non_finite(run, frame, place);
}

void fill_frame(Simulation& simulation, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame& out) {
    out.frame = frame;
    out.time = double(frame) / fps;
    if (const std::string place = simulation.fill(fields, out); !place.empty())
        fail_non_finite(simulation, frame, place);
    if (const std::string what = beyond_floats(out); !what.empty()) throw PromiseError(what);
}

} // namespace bough
