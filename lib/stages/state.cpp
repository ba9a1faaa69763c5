#include "state.h"
#include "../fast/analytic_lanes_step.h"
#include "../fast/coupled_lanes_step.h"
#include "frozen.h"
#include "root_term.h"
#include "spring.h"
#include "state_arrays.h"
#include "state_update.h"
#include <algorithm>
#include <bit>
#include <type_traits>

namespace bough {

namespace {

template <class T> void set_zero(T& value) {
    if constexpr (std::is_floating_point_v<T>)
        value = 0;
    else if constexpr (requires { value.setZero(); })
        value.setZero(); // the rest is a step's own scratch
}

} // namespace

template <class T> State<T> make_state(const Plan<T>& plan) {
    State<T> state;
    visit_arrays(plan, state, [&](const char*, auto& array, bool on, const std::string&) {
        if (!on) return;
        array.resize(plan.bodies);
        for (auto& value : array) set_zero(value);
    });
    state.theta = plan.theta_start;
    state.articulated.resize(articulated_passes(plan.solver));
    for (ArticulatedPass& pass : state.articulated) {
        pass.body.resize(plan.bodies);
        pass.ground.resize(plan.splines.size());
        if (plan.wind) pass.wind = make_wind_table<double>(*plan.scene.wind, plan.top);
    }
    if (plan.wind && !is_articulated(plan.solver)) state.wind = make_wind_table<T>(*plan.scene.wind, plan.top);
    if (plan.solver == Solver::coupled) {
        state.wind_change = state.wind;
        state.coupled_ground.resize(plan.splines.size());
        state.account.resize(std::size_t(std::count(plan.parent.begin(), plan.parent.end(), -1)));
    }
    state.ground.resize(plan.splines.size());
    state.root_load.resize(plan.splines.size());
    restart(plan, state);
    return state;
}

template <class T> void restart(const Plan<T>& plan, State<T>& state) {
    move_ground(plan, state, double(state.step) * plan.dt);
    state_update(plan, state);
    if (plan.torque) spring_torque(plan, state);
    forget_frozen(state);
    if (!plan.lanes.on) return;
    if (plan.solver == Solver::analytic)
        fast::pack_analytic(plan, state);
    else
        fast::pack(plan, state);
}

template <class T> std::size_t State<T>::bytes() const {
    std::size_t sum = 0;
    visit_arrays(Plan<T>(), *this, [&](const char*, const auto& array, bool, const std::string&) {
        sum += array.capacity() * sizeof(array[0]);
    });
    for (const auto* rows :
         {&lanes.now, &lanes.next, &lanes.solved, &lanes.frozen, &lanes.outward, &lanes.inward, &lanes.accelerated})
        sum += rows->capacity() * sizeof(fast::Row<T>);
    for (const ArticulatedPass& pass : articulated) sum += pass.body.capacity() * sizeof(ArticulatedBody);
    return sum;
}

template <class T> std::uint64_t state_hash(const State<T>& state) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&hash](const std::vector<Vector3<T>>& array) {
        for (const Vector3<T>& v : array)
            for (int k = 0; k < 3; ++k) {
                using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
                const Bits bits = std::bit_cast<Bits>(T(v[k]));
                for (unsigned shift = 0; shift < 8 * sizeof(T); shift += 8) {
                    hash ^= (bits >> shift) & 0xff;
                    hash *= 0x100000001b3u;
                }
            }
    };
    add(state.theta);
    add(state.theta_dot);
    return hash;
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
template std::optional<std::size_t> first_non_finite(const State<float>&);
template std::optional<std::size_t> first_non_finite(const State<double>&);

} // namespace bough
