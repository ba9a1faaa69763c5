#include "state.h"
#include "../base/fnv.h"
#include <cassert>

namespace bough {

template <class T> State<T> make_state(const Plan<T>& plan) {
    State<T> state;
    const Vector3<T> none = Vector3<T>::Zero();
    if (plan.pose) {
        state.theta = plan.theta_start;
        state.theta_dot.assign(plan.bodies, none);
        state.R_wb.assign(plan.bodies, Matrix3<T>::Zero());
        state.x_w.assign(plan.bodies, none);
    }
    if (plan.velocity) state.omega_w.assign(plan.bodies, none);
    if (plan.velocity) state.v_w.assign(plan.bodies, none);
    if (plan.torque) state.torque_j.assign(plan.bodies, none);
    state.ground.resize(plan.splines.size());
    plan.stepper->allocate(plan, state);
    plan.stepper->begin(plan, state, plan.theta_start);
    return state;
}

template <class T> void restart(const Plan<T>& plan, State<T>& state) {
    assert(state.theta.size() == plan.bodies); // without Plan::pose: there since present()
    plan.stepper->begin(plan, state, state.theta);
}

template <class T> void advance(const Plan<T>& plan, State<T>& state, StageClock* clock) {
    plan.stepper->advance(plan, state, clock);
}

template <class T> void present(const Plan<T>& plan, State<T>& state) {
    plan.stepper->present(plan, state);
}

template <class T> std::size_t State<T>::bytes() const {
    std::size_t sum = own ? own->bytes() : 0;
    for (const auto* array : {&theta, &theta_dot, &x_w, &omega_w, &v_w, &torque_j})
        sum += array->capacity() * sizeof(Vector3<T>);
    return sum + R_wb.capacity() * sizeof(Matrix3<T>);
}

template <class T> std::uint64_t state_hash(const State<T>& state) {
    Fnv hash;
    for (const auto* array : {&state.theta, &state.theta_dot})
        for (const Vector3<T>& v : *array)
            for (int k = 0; k < 3; ++k) hash.add(v[k]);
    return hash.value();
}

template <class T> std::uint64_t state_hash(const Plan<T>& plan, const State<T>& state) {
    MotionView<T> view;
    plan.stepper->view_motion(state, view);
    Fnv hash;
    for (const T* quantity : {view.theta, view.theta_dot})
        for (std::size_t i = 0; i < plan.bodies; ++i)
            for (std::size_t k = 0; k < 3; ++k) hash.add(quantity[view.at(i) + k * view.stride]);
    return hash.value();
}

template <class T> std::optional<std::size_t> first_non_finite(const State<T>& state) {
    for (std::size_t i = 0; i < state.theta.size(); ++i)
        if (!state.theta[i].allFinite() || !state.theta_dot[i].allFinite()) return i;
    return std::nullopt;
}

template <class T> std::optional<NonFinite> Stepper<T>::non_finite(const Plan<T>& plan, State<T>& state) const {
    present(plan, state);
    const std::optional<std::size_t> body = first_non_finite(state);
    if (!body) return std::nullopt;
    return NonFinite{std::string(stage_name(kind_.stage)) + " (theta)", *body};
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template struct State<T>;                                                                                          \
    template State<T> make_state(const Plan<T>&);                                                                      \
    template void restart(const Plan<T>&, State<T>&);                                                                  \
    template void advance(const Plan<T>&, State<T>&, StageClock*);                                                     \
    template void present(const Plan<T>&, State<T>&);                                                                  \
    template std::uint64_t state_hash(const State<T>&);                                                                \
    template std::uint64_t state_hash(const Plan<T>&, const State<T>&);                                                \
    template std::optional<std::size_t> first_non_finite(const State<T>&);                                             \
    template std::optional<NonFinite> Stepper<T>::non_finite(const Plan<T>&, State<T>&) const;
#include "../base/instantiate.inc"

} // namespace bough
