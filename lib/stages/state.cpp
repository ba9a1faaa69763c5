#include "state.h"
#include "../fast/analytic_lanes_step.h"
#include "../fast/analytic_rows.h"
#include "../fast/coupled_lanes_step.h"
#include "../fast/lane_tables.h"
#include "../model/fnv.h"
#include "root_term.h"
#include "spring.h"
#include "state_arrays.h"
#include "state_update.h"
#include <algorithm>
#include <cassert>
#include <type_traits>

namespace bough {

namespace {

template <class T> void set_zero(T& value) {
    if constexpr (std::is_floating_point_v<T>)
        value = 0;
    else if constexpr (requires { value.setZero(); })
        value.setZero(); // the rest is a step's own scratch
}

// The rows hold them; present() makes them again when they are read.
template <class T> void leave_out_angles(State<T>& state) {
    for (auto* array :
         {&state.theta, &state.theta_dot, &state.scaled_rate, &state.theta_change, &state.theta_dot_change})
        std::vector<Vector3<T>>().swap(*array);
    state.lanes.presented = false;
}

// Kinematics, ground and rows as of `theta` and what else the state holds.
template <class T> void begin(const Plan<T>& plan, State<T>& state, const std::vector<Vector3<T>>& theta) {
    move_ground(plan, state, double(state.step) * plan.dt);
    if (plan.pose) state_update(plan, state);
    if (plan.torque) spring_torque(plan, state);
    if (!plan.lanes.on) return;
    if (plan.solver == Solver::analytic)
        fast::pack_analytic(plan, state, theta);
    else
        fast::pack(plan, state, theta);
    if (!plan.pose) leave_out_angles(state);
}

} // namespace

template <class T> State<T> make_state(const Plan<T>& plan) {
    State<T> state;
    visit_arrays(plan, state, [&](const char*, auto& array, bool on, const std::string&) {
        if (!on) return;
        array.resize(plan.bodies);
        for (auto& value : array) set_zero(value);
    });
    if (plan.pose) state.theta = plan.theta_start;
    state.articulated.resize(articulated_passes(plan.solver));
    for (ArticulatedPass& pass : state.articulated) {
        pass.body.resize(plan.bodies);
        pass.ground.resize(plan.splines.size());
        if (plan.wind) pass.wind = make_wind_table<double>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    }
    if (plan.wind && !is_articulated(plan.solver))
        state.wind = make_wind_table<T>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    if (plan.solver == Solver::coupled) {
        if (plan.field)
            state.wind_start = state.wind_end = state.wind.field;
        else
            state.wind_change = state.wind;
        state.coupled_ground.resize(plan.splines.size());
        state.account.resize(plan.lanes.on ? plan.lanes.layout.ground.size()
                                           : std::size_t(std::count(plan.parent.begin(), plan.parent.end(), -1)));
    }
    state.ground.resize(plan.splines.size());
    state.root_load.resize(plan.splines.size());
    begin(plan, state, plan.theta_start);
    return state;
}

template <class T> void restart(const Plan<T>& plan, State<T>& state) {
    assert(state.theta.size() == plan.bodies); // without Plan::pose: there since present()
    begin(plan, state, state.theta);
}

template <class T> std::size_t State<T>::bytes() const {
    std::size_t sum = 0;
    visit_arrays(Plan<T>(), *this, [&](const char*, const auto& array, bool, const std::string&) {
        sum += array.capacity() * sizeof(array[0]);
    });
    for (const auto* rows : {&lanes.now, &lanes.table, &lanes.outward, &lanes.inward, &lanes.accelerated})
        sum += rows->capacity() * sizeof(fast::Row<T>);
    for (const ArticulatedPass& pass : articulated) sum += pass.body.capacity() * sizeof(ArticulatedBody);
    return sum;
}

template <class T> std::uint64_t state_hash(const State<T>& state) {
    Fnv hash;
    for (const auto* array : {&state.theta, &state.theta_dot})
        for (const Vector3<T>& v : *array)
            for (int k = 0; k < 3; ++k) hash.add(v[k]);
    return hash.value();
}

template <class T> std::uint64_t state_hash(const Plan<T>& plan, const State<T>& state) {
    if (!plan.lanes.on) return state_hash(state);
    const bool analytic = plan.solver == Solver::analytic;
    const fast::RowVector<T>& rows = analytic ? state.lanes.now : state.lanes.table;
    static_assert(fast::motion::theta == 0 && fast::motion::theta_dot == 3 && fast::analytic::motion::theta == 0);
    const std::vector<std::size_t> motion_at = fast::motion_of_rows(plan, state);
    constexpr std::size_t lanes = fast::Row<T>::lanes;
    Fnv hash;
    for (const std::size_t first : {std::size_t(0), std::size_t(3)})
        for (const std::uint32_t slot : plan.lanes.layout.slot) {
            if (analytic && first > 0) {
                const Vector3<T> theta_dot = fast::analytic_theta_dot(state, slot);
                for (int k = 0; k < 3; ++k) hash.add(theta_dot[k]);
                continue;
            }
            for (std::size_t k = first; k < first + 3; ++k)
                hash.add(rows[motion_at[slot / lanes] + k].lane[slot % lanes]);
        }
    return hash.value();
}

template <class T> std::optional<std::size_t> first_non_finite(const State<T>& state) {
    for (std::size_t i = 0; i < state.theta.size(); ++i)
        if (!state.theta[i].allFinite() || !state.theta_dot[i].allFinite()) return i;
    return std::nullopt;
}

template struct State<float>;
template struct State<double>;
template State<float> make_state(const Plan<float>&);
template State<double> make_state(const Plan<double>&);
template void restart(const Plan<float>&, State<float>&);
template void restart(const Plan<double>&, State<double>&);
template std::uint64_t state_hash(const State<float>&);
template std::uint64_t state_hash(const State<double>&);
template std::uint64_t state_hash(const Plan<float>&, const State<float>&);
template std::uint64_t state_hash(const Plan<double>&, const State<double>&);
template std::optional<std::size_t> first_non_finite(const State<float>&);
template std::optional<std::size_t> first_non_finite(const State<double>&);

} // namespace bough
