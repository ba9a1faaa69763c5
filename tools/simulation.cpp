#include "simulation.h"
#include "exits.h"
#include "formats/open.h"

namespace bough {
namespace {

// What the library refuses is told of as the input's.
template <class Make> auto as_input(const RunOptions& o, Make&& make) {
    try {
        return make();
    } catch (const SceneError& error) {
        const std::string what = error.what(), file = wind_file(o.wind), wind = "/wind/";
        if (!file.empty() && what.compare(0, wind.size(), wind) == 0) // it stands there without that folder
            throw InputError(input_name(file), what.substr(wind.size() - 1));
        throw InputError(input_name(o.input), what);
    }
}

[[noreturn]] void fail_non_finite(std::int64_t frame, const std::string& place) {
    throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) + ": " + place);
}

template <class T> std::string advice(const Plan<T>& plan) {
    if (plan.stepper->name() != std::string(solver_name(Solver::articulated_explicit))) return "";
    return "; explicit Euler needs far smaller steps (--substeps), or take --solver articulated-implicit";
}

template <class T> std::unique_ptr<Stepper<T>> stepper_of(const Setting& setting, const RunOptions& o) {
    StepChoice choice;
    choice.simd = chosen_simd(o);
    choice.sleep = chosen_sleep(o);
    const Solver solver = chosen_solver(o);
    keep_to_the_whole(setting.part, solver == Solver::analytic ? Method::analytic : Method::coupled, choice);
    return make_stepper<T>({solver, chosen_scheme(o), choice.simd, choice.sleep, o.tolerance.value_or(1e-8)},
                           setting.scene);
}

} // namespace

double step_length(const RunOptions& o) {
    return 1 / (o.fps * o.substeps);
}

template <class T> Plan<T> planned(const Setting& setting, const Wishes& wishes, const RunOptions& o) {
    return as_input(o, [&] { return plan_run<T>(setting, wishes, step_length(o), stepper_of<T>(setting, o)); });
}

template <class T> Plan<T> planned(Setting&& setting, const Wishes& wishes, const RunOptions& o) {
    std::unique_ptr<Stepper<T>> stepper = stepper_of<T>(setting, o);
    return as_input(o, [&] { return plan_run<T>(std::move(setting), wishes, step_length(o), std::move(stepper)); });
}

template <class T> Run<T> started(Plan<T> plan, const Setting& setting, const RunOptions& o) {
    return as_input(o, [&] { return start_run(std::move(plan), setting); });
}

template <class T>
void advance_frame(Run<T>& run, const Tree& tree, std::int64_t frame, int substeps, StageClock* clock) {
    for (int k = 0; k < substeps; ++k)
        if (const std::string place = advance_run(run, tree, clock); !place.empty())
            fail_non_finite(frame, place + advice(run.plan));
}

template <class T> void require_finite(const Plan<T>& plan, State<T>& state, const Tree& tree, std::int64_t frame) {
    if (const std::string place = non_finite(plan, state, tree); !place.empty())
        fail_non_finite(frame, place + advice(plan));
}

template <class T>
void fill_frame(const State<T>& state, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame& out) {
    out.frame = frame;
    out.time = double(frame) / fps;
    if (const std::optional<std::size_t> body = fill_frame(state, fields, out))
        fail_non_finite(frame, "stage state_update, body " + std::to_string(*body));
}

template Plan<float> planned(const Setting&, const Wishes&, const RunOptions&);
template Plan<double> planned(const Setting&, const Wishes&, const RunOptions&);
template Plan<float> planned(Setting&&, const Wishes&, const RunOptions&);
template Plan<double> planned(Setting&&, const Wishes&, const RunOptions&);
template Run<float> started(Plan<float>, const Setting&, const RunOptions&);
template Run<double> started(Plan<double>, const Setting&, const RunOptions&);
template void advance_frame(Run<float>&, const Tree&, std::int64_t, int, StageClock*);
template void advance_frame(Run<double>&, const Tree&, std::int64_t, int, StageClock*);
template void require_finite(const Plan<float>&, State<float>&, const Tree&, std::int64_t);
template void require_finite(const Plan<double>&, State<double>&, const Tree&, std::int64_t);
template void fill_frame(const State<float>&, std::int64_t, double, const MotionFields&, MotionFrame&);
template void fill_frame(const State<double>&, std::int64_t, double, const MotionFields&, MotionFrame&);

} // namespace bough
