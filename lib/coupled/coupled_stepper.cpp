#include "coupled_stepper.h"
#include "../plan/attachment_course.h"
#include "../plan/state_update.h"
#include "attachment.h"
#include "coupled_step.h"
#include <algorithm>

namespace bough {

template <class T> std::vector<CarriedArray<T>> carried_by_coupled(State<T>& state) {
    CoupledState<T>& own = coupled_state(state);
    return {{"theta_change", &own.theta_change}, {"theta_dot_change", &own.theta_dot_change}};
}

template <class T> void scale_changes(State<T>& state, T ratio) {
    if (ratio == 1) return;
    CoupledState<T>& own = coupled_state(state);
    for (auto* array : {&own.theta_change, &own.theta_dot_change})
        for (Vector3<T>& change : *array) change *= ratio;
}

StepperKind coupled_kind(Scheme scheme, std::string plainly) {
    return {.name = "coupled",
            .plainly = std::move(plainly),
            .stage = Stage::resolvent,
            .scheme = scheme_of(scheme).name,
            .places_points = true}; // pulled_points.h, attachment.h
}

template <class T> void drop_from_coupled(Plan<T>& plan, State<T>& state, std::size_t i) {
    plan.mass[i] = plan.c_mass[i] = 0;
    plan.inertia_joint[i].setZero();
    plan.K[i].setOnes();
    plan.beta[i] = 0;
    if (!plan.drag_area.empty()) plan.drag_area[i] = 0;
    CoupledState<T>& own = coupled_state(state);
    for (auto* array : {&state.theta, &state.theta_dot, &own.theta_change, &own.theta_dot_change})
        if (!array->empty()) (*array)[i].setZero();
}

template <class T>
CoupledStepper<T>::CoupledStepper(Scheme scheme, std::string plainly)
    : Cloned<CoupledStepper<T>, PlainStepper<T>, Stepper<T>>(coupled_kind(scheme, std::move(plainly))), own{scheme,
                                                                                                            {},
                                                                                                            {}} {}

template <class T> void CoupledStepper<T>::take_constants(const Plan<T>& plan, const Tree& tree) {
    take_coupled_constants(plan, tree, own);
    this->carries_moments_ = plan.gravity;
}

template <class T> void CoupledStepper<T>::allocate(const Plan<T>& plan, State<T>& state) const {
    auto work = std::make_unique<CoupledWork<T>>();
    const auto roots = std::size_t(std::count(plan.parent.begin(), plan.parent.end(), -1));
    allocate_coupled(plan, state, *work, roots);
    begin_attachments(plan, *work);
    work->coupled.resize(plan.bodies);
    const bool real = scheme_of(own.scheme).real;
    if (!real) work->resolvent.resize(plan.bodies);
    if (real || plan.joint_limit) work->resolvent_real.resize(plan.bodies);
    work->guard.resize(plan.bodies);
    state.own = Copied<StepperState>(std::move(work));
}

template <class T> void CoupledStepper<T>::advance(const Plan<T>& plan, State<T>& state, StageClock* clock) const {
    coupled_step(plan, own, state, static_cast<CoupledWork<T>&>(*state.own), clock);
}

template <class T> std::vector<CarriedArray<T>> CoupledStepper<T>::carried(State<T>& state) const {
    return carried_by_coupled(state);
}

template <class T>
void CoupledStepper<T>::drop(Plan<T>& plan, State<T>& state, const std::vector<std::size_t>& bodies,
                             const std::vector<CarriedMoment>& carried) {
    for (const CarriedMoment& left : carried) own.carried_moment[left.body] = left.moment.template cast<T>();
    for (const std::size_t i : bodies) {
        drop_from_coupled(plan, state, i);
        if (!own.carried_moment.empty()) own.carried_moment[i].setZero();
        if (!own.carried_drag.empty()) own.carried_drag[i].setZero(); // what bore it keeps its own: any will do (air.h)
    }
    release_from(plan, coupled_state(state), bodies);
    state_update(plan, state);
}

template <class T> void CoupledStepper<T>::save(const State<T>& state, SavedState& saved) const {
    saved.attachments = saved_attachments(coupled_state(state).attachments.all);
}

template <class T> void CoupledStepper<T>::restore(State<T>& state, const SavedState& saved) const {
    restore_attachments(coupled_state(state).attachments.all, saved.attachments);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template class CoupledStepper<T>;                                                                                  \
    template std::vector<CarriedArray<T>> carried_by_coupled(State<T>&);                                               \
    template void scale_changes(State<T>&, T);                                                                         \
    template void drop_from_coupled(Plan<T>&, State<T>&, std::size_t);
#include "../base/instantiate.inc"

} // namespace bough
