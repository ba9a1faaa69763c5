#include "saved.h"
#include "../fast/sleep.h"
#include <stdexcept>

namespace bough {
namespace {

// visit(in memory, in the document, its name) for each array that the solver carries from step to step (State).
template <class T, class StateType, class Saved, class Visit>
void visit_carried(const Plan<T>& plan, StateType& state, Saved& saved, Visit&& visit) {
    visit(state.theta, saved.theta, "theta");
    visit(state.theta_dot, saved.theta_dot, "theta_dot");
    if (plan.solver == Solver::coupled) {
        visit(state.theta_change, saved.theta_change, "theta_change");
        visit(state.theta_dot_change, saved.theta_dot_change, "theta_dot_change");
    } else {
        visit(state.scaled_rate, saved.scaled_rate, "scaled_rate");
        if (plan.fictitious) visit(state.spin_dot, saved.spin_dot, "spin_dot");
    }
}

} // namespace

template <class T> void save_run(Run<T>& run, std::int64_t frame, SavedState& saved) {
    present(run.plan, run.state);
    saved.frame = frame;
    saved.articulated_step = run.state.articulated_step;
    saved.sleep = fast::saved_sleep(run.plan, run.state);
    saved.free_bodies = saved_world(run.state, run.world);
    visit_carried(run.plan, run.state, saved,
                  [](const std::vector<Vector3<T>>& from, std::vector<Vec3>& to, const char*) {
                      for (const Vector3<T>& v : from) to.push_back(v.template cast<double>());
                  });
}

template <class T> void restore_run(const SavedState& saved, std::int64_t step, Run<T>& run) {
    Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    if (saved.theta.size() != plan.bodies)
        throw SceneError("/theta: is " + std::to_string(saved.theta.size()) + " bodies, but this run has " +
                         std::to_string(plan.bodies) + " bodies");
    try {
        restore_world(plan, state, run.world, saved.free_bodies);
    } catch (const std::invalid_argument& error) {
        throw SceneError(std::string("/free_bodies: ") + error.what());
    }
    present(plan, state); // its arrays
    visit_carried(plan, state, saved, [](std::vector<Vector3<T>>& to, const std::vector<Vec3>& from, const char* name) {
        if (from.size() != to.size())
            throw SceneError("/" + std::string(name) + ": is " + std::to_string(from.size()) +
                             " bodies, but this run has " + std::to_string(to.size()));
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i].template cast<T>();
    });
    state.articulated_step = saved.articulated_step;
    state.step = step;
    restart(plan, state);
    try {
        if (plan.lanes.sleep.on) fast::restore_sleep(plan, state, saved.sleep); // else what slept goes on awake
    } catch (const std::invalid_argument& error) {
        throw SceneError(std::string("/sleep: ") + error.what());
    }
}

template void save_run(Run<float>&, std::int64_t, SavedState&);
template void save_run(Run<double>&, std::int64_t, SavedState&);
template void restore_run(const SavedState&, std::int64_t, Run<float>&);
template void restore_run(const SavedState&, std::int64_t, Run<double>&);

} // namespace bough
