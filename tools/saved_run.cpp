#include "saved_run.h"
#include "exits.h"
#include "formats/documents/motion.h"
#include "formats/open.h"
#include "lib/fast/sleep.h"

namespace bough {
namespace {

// visit(in memory, in the document) for each array that the solver carries from step to step (State).
template <class T, class StateType, class Saved, class Visit>
void visit_carried(const Plan<T>& plan, StateType& state, Saved& saved, Visit&& visit) {
    visit(state.theta, saved.theta);
    visit(state.theta_dot, saved.theta_dot);
    if (plan.solver == Solver::coupled) {
        visit(state.theta_change, saved.theta_change);
        visit(state.theta_dot_change, saved.theta_dot_change);
    } else {
        visit(state.scaled_rate, saved.scaled_rate);
        if (plan.fictitious) visit(state.spin_dot, saved.spin_dot);
    }
}

} // namespace

template <class T> void restore(const TreesimOptions& o, const Setting& setting, const SavedState& saved, Run<T>& run) {
    Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    const auto refuse = [&](const std::string& field, const std::string& found, const std::string& expected) {
        if (found != expected)
            throw InputError(input_name(o.resume), "/" + field + ": is " + found + ", but this run has " + expected);
    };
    refuse("precision", saved.precision, o.run.precision);
    refuse("solver", saved.solver, o.run.solver);
    refuse("scheme", saved.scheme, scheme_name(o.run));
    refuse("substeps", std::to_string(saved.substeps), std::to_string(o.run.substeps));
    if (saved.fps != o.run.fps) throw InputError(input_name(o.resume), "/fps: differs from this run's (--fps)");
    refuse("theta", std::to_string(saved.theta.size()) + " bodies", std::to_string(plan.bodies) + " bodies");
    if (saved.fingerprint != setting.fingerprint)
        throw InputError(input_name(o.resume), "/fingerprint: is " + hash_text(saved.fingerprint) +
                                                   ", but this run's tree and scene have " +
                                                   hash_text(setting.fingerprint));
    refuse("whole", saved.whole, setting.part.parts > 1 ? hash_text(setting.part.whole) : "");
    if (const std::size_t held = saved.spin_dot.size(); held != (plan.fictitious ? plan.bodies : 0))
        throw InputError(input_name(o.resume), "/spin_dot: is " + std::to_string(held) + " bodies, but this run has " +
                                                   std::to_string(plan.fictitious ? plan.bodies : 0));
    try {
        restore_world(plan, state, run.world, saved.free_bodies);
    } catch (const std::invalid_argument& error) {
        throw InputError(input_name(o.resume), std::string("/free_bodies: ") + error.what());
    }
    present(plan, state); // its arrays
    visit_carried(plan, state, saved, [](std::vector<Vector3<T>>& to, const std::vector<Vec3>& from) {
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i].template cast<T>();
    });
    state.articulated_step = saved.articulated_step;
    state.step = saved.frame * o.run.substeps;
    restart(plan, state);
    try {
        if (plan.lanes.sleep.on) fast::restore_sleep(plan, state, saved.sleep); // else what slept goes on awake
    } catch (const std::invalid_argument& error) {
        throw InputError(input_name(o.resume), std::string("/sleep: ") + error.what());
    }
}

template <class T> void save(const TreesimOptions& o, const Setting& setting, Run<T>& run, std::int64_t frame) {
    const Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    present(plan, state);
    SavedState saved;
    saved.frame = frame;
    saved.fps = o.run.fps;
    saved.substeps = o.run.substeps;
    saved.precision = o.run.precision;
    saved.solver = o.run.solver;
    saved.scheme = scheme_name(o.run);
    saved.fingerprint = setting.fingerprint;
    saved.part = setting.part.part;
    saved.parts = setting.part.parts;
    if (setting.part.parts > 1) saved.whole = hash_text(setting.part.whole);
    saved.articulated_step = state.articulated_step;
    saved.source = with_command_line(setting.source, o.common);
    saved.sleep = fast::saved_sleep(plan, state);
    saved.free_bodies = saved_world(state, run.world);
    visit_carried(plan, state, saved, [](const std::vector<Vector3<T>>& from, std::vector<Vec3>& to) {
        for (const Vector3<T>& v : from) to.push_back(v.template cast<double>());
    });
    Output output(o.save_state);
    write_state(output, saved, form_of_name(o.save_state));
    output.finish();
}

template void restore(const TreesimOptions&, const Setting&, const SavedState&, Run<float>&);
template void restore(const TreesimOptions&, const Setting&, const SavedState&, Run<double>&);
template void save(const TreesimOptions&, const Setting&, Run<float>&, std::int64_t);
template void save(const TreesimOptions&, const Setting&, Run<double>&, std::int64_t);

} // namespace bough
