#include "analytic_stepper.h"
#include "../laws/wind.h"
#include "../plan/attachment_course.h"
#include "../plan/state_update.h"
#include "analytic_step.h"
#include "fictitious.h"
#include "held_points.h"
#include <cmath>
#include <stdexcept>

namespace bough {
namespace {

template <class T> AnalyticWork<T>& work_of(State<T>& state) {
    return static_cast<AnalyticWork<T>&>(*state.own);
}

template <class V> bool is_finite(const V& value) {
    if constexpr (std::is_floating_point_v<V>)
        return std::isfinite(value);
    else
        return value.allFinite();
}

template <class V> V zero() {
    if constexpr (std::is_floating_point_v<V>)
        return 0;
    else
        return V::Zero();
}

// The stage before the spring that writes an array whose numbers go straight into it, bounds aside.
const char* early_stage(const std::string& array) {
    if (array.rfind("c_", 0) == 0) return stage_name(Stage::composite);
    if (array == "f_w" || array == "tau_w" || array.rfind("drag_", 0) == 0) return stage_name(Stage::external_forces);
    return nullptr;
}

} // namespace

template <class T> std::size_t AnalyticWork<T>::bytes() const {
    std::size_t sum = this->scaled_rate.capacity() * sizeof(Vector3<T>) + held.bytes();
    visit_arrays(*this,
                 [&](const char*, const auto& array, AnalyticNeed) { sum += array.capacity() * sizeof(array[0]); });
    return sum;
}

void refuse_with_analytic(const Scene& scene) {
    for (std::size_t k = 0; k < scene.pulls.size(); ++k)
        if (scene.pulls[k].in_body)
            throw std::domain_error("pulls/" + std::to_string(k) +
                                    "/axes: is body, for solver coupled only, expected world with solver analytic");
}

template <class T> void drop_from_analytic(Plan<T>& plan, State<T>& state, std::size_t i) {
    plan.mass[i] = plan.c_mass[i] = 0;
    plan.inertia_joint[i] = pad_inertia<T> * Matrix3<T>::Identity();
    plan.K[i] = Vector3<T>::Constant(pad_inertia<T> * pad_rate2<T>);
    plan.beta[i] = 0;
    if (!plan.drag_area.empty()) plan.drag_area[i] = 0;
    for (auto* array : {&state.theta, &state.theta_dot, &analytic_state(state).scaled_rate})
        if (!array->empty()) (*array)[i].setZero();
}

// Its drag is on the velocities of the step before.
template <class T>
AnalyticStepper<T>::AnalyticStepper(const Scene& scene, std::string plainly)
    : Cloned<AnalyticStepper<T>, PlainStepper<T>, Stepper<T>>(
          StepperKind{.name = "analytic",
                      .plainly = std::move(plainly),
                      .stage = Stage::spring,
                      .reads_velocities = scene.wind || (scene.fictitious && lags(*scene.fictitious))}) {}

template <class T> void AnalyticStepper<T>::allocate(const Plan<T>& plan, State<T>& state) const {
    auto work = std::make_unique<AnalyticWork<T>>();
    work->scaled_rate.assign(plan.bodies, Vector3<T>::Zero());
    visit_arrays(*work, [&](const char*, auto& array, AnalyticNeed need) {
        if (needs_array(plan, own.fictitious, need))
            array.assign(plan.bodies, zero<std::decay_t<decltype(array[0])>>());
    });
    work->root_load.resize(plan.splines.size());
    if (!plan.attachments.empty()) work->held = planned_held(plan);
    if (plan.wind) state.wind = make_wind_table<T>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    state.own = Copied<StepperState>(std::move(work));
}

template <class T>
void AnalyticStepper<T>::begin(const Plan<T>& plan, State<T>& state, const std::vector<Vector3<T>>&) const {
    update_kinematics(plan, state);
    if (own.fictitious) accelerations(plan, state, work_of(state));
}

template <class T> void AnalyticStepper<T>::advance(const Plan<T>& plan, State<T>& state, StageClock* clock) const {
    analytic_step(plan, own, state, work_of(state), clock);
}

template <class T> std::optional<NonFinite> AnalyticStepper<T>::non_finite(const Plan<T>& plan, State<T>& state) const {
    std::optional<NonFinite> found = Stepper<T>::non_finite(plan, state);
    if (!found) return found;
    bool early = false;
    visit_arrays(static_cast<const AnalyticWork<T>&>(*state.own),
                 [&](const std::string& name, const auto& array, AnalyticNeed) {
                     const char* stage = early ? nullptr : early_stage(name);
                     for (std::size_t i = 0; stage && !early && i < array.size(); ++i)
                         if ((early = !is_finite(array[i])))
                             found = NonFinite{std::string(stage) + " (" + name + ")", i};
                 });
    return found;
}

template <class T> std::vector<CarriedArray<T>> AnalyticStepper<T>::carried(State<T>& state) const {
    AnalyticWork<T>& work = work_of(state);
    std::vector<CarriedArray<T>> arrays{{"scaled_rate", &work.scaled_rate}};
    if (own.fictitious) arrays.push_back({"spin_dot", &work.spin_dot});
    return arrays;
}

template <class T> void AnalyticStepper<T>::save(const State<T>& state, SavedState& saved) const {
    saved.attachments = saved_attachments(static_cast<const AnalyticWork<T>&>(*state.own).held.all);
}

template <class T> void AnalyticStepper<T>::restore(State<T>& state, const SavedState& saved) const {
    restore_attachments(work_of(state).held.all, saved.attachments);
}

template <class T>
void AnalyticStepper<T>::drop(Plan<T>& plan, State<T>& state, const std::vector<std::size_t>& bodies,
                              const std::vector<CarriedMoment>&) {
    AnalyticWork<T>& work = work_of(state);
    for (const std::size_t i : bodies) {
        drop_from_analytic(plan, state, i);
        if (!own.gravity_row.empty()) own.gravity_row[i] = 0;
        if (!work.spin_dot.empty()) work.spin_dot[i].setZero();
    }
    release_held(plan, work, bodies);
    state_update(plan, state);
    if (own.fictitious) accelerations(plan, state, work);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template struct AnalyticWork<T>;                                                                                   \
    template void drop_from_analytic(Plan<T>&, State<T>&, std::size_t);                                                \
    template class AnalyticStepper<T>;
#include "../base/instantiate.inc"

} // namespace bough
