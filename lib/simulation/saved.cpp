#include "saved.h"
#include <stdexcept>

namespace bough {
namespace {

// The document's array of a carried one's name.
template <class Saved> auto& array_of(Saved& saved, const std::string& name) {
    for (const auto& [known, array] : {std::pair{"theta_change", &SavedState::theta_change},
                                       {"theta_dot_change", &SavedState::theta_dot_change},
                                       {"scaled_rate", &SavedState::scaled_rate},
                                       {"spin_dot", &SavedState::spin_dot}})
        if (name == known) return saved.*array;
    throw std::logic_error("a saved state has no " + name);
}

// visit(in memory, in the document, its name) for each array that is carried from step to step.
template <class T, class Saved, class Visit>
void visit_carried(const Plan<T>& plan, State<T>& state, Saved& saved, Visit&& visit) {
    visit(state.theta, saved.theta, "theta");
    visit(state.theta_dot, saved.theta_dot, "theta_dot");
    for (const CarriedArray<T>& carried : plan.stepper->carried(state))
        visit(*carried.array, array_of(saved, carried.name), carried.name);
}

} // namespace

double saved_time(const SavedState& saved, std::int64_t step, double dt) {
    if (saved.step_change.empty()) return double(step) * dt;
    return saved.step_change[1] + (double(step) - saved.step_change[0]) * dt;
}

template <class T> void save_run(Run<T>& run, std::int64_t frame, SavedState& saved) {
    present(run.plan, run.state);
    saved.frame = frame;
    if (run.state.step_since != 0 || run.state.time_since != 0)
        saved.step_change = {double(run.state.step_since), run.state.time_since};
    run.plan.stepper->save(run.state, saved);
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
    state.step = step;
    state.step_since = saved.step_change.empty() ? 0 : std::int64_t(saved.step_change[0]);
    state.time_since = saved.step_change.empty() ? 0 : saved.step_change[1];
    restart(plan, state);
    try {
        plan.stepper->restore(state, saved);
    } catch (const std::invalid_argument& error) {
        throw SceneError(std::string("/sleep: ") + error.what());
    } catch (const std::length_error& error) {
        throw SceneError(std::string("/attachments: ") + error.what());
    }
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void save_run(Run<T>&, std::int64_t, SavedState&);                                                        \
    template void restore_run(const SavedState&, std::int64_t, Run<T>&);
#include "../base/instantiate.inc"

} // namespace bough
