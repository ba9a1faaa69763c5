#include "lane_steppers.h"
#include "../analytic/analytic_stepper.h"
#include "../analytic/fictitious.h"
#include "../coupled/coupled_stepper.h"
#include "../model/fnv.h"
#include "../stages/state_update.h"
#include "../stages/wind.h"
#include "analytic_lanes_step.h"
#include "analytic_rows.h"
#include "clear_lanes.h"
#include "coupled_lanes_step.h"
#include "coupled_tables.h"
#include "plan_lanes.h"
#include "sleep.h"

namespace bough::fast {
namespace {

template <class T> CoupledLanesState<T>& coupled_work(State<T>& state) {
    return static_cast<CoupledLanesState<T>&>(*state.own);
}
template <class T> const CoupledLanesState<T>& coupled_work(const State<T>& state) {
    return static_cast<const CoupledLanesState<T>&>(*state.own);
}
template <class T> AnalyticLanesState<T>& analytic_work(State<T>& state) {
    return static_cast<AnalyticLanesState<T>&>(*state.own);
}
template <class T> const AnalyticLanesState<T>& analytic_work(const State<T>& state) {
    return static_cast<const AnalyticLanesState<T>&>(*state.own);
}

template <class... Arrays> void give_back(Arrays&... arrays) {
    (Arrays().swap(arrays), ...);
}

// Rows of `count` quantities each.
std::vector<std::size_t> even_rows(const Layout& layout, std::size_t count) {
    std::vector<std::size_t> at(layout.rows);
    for (std::size_t row = 0; row < at.size(); ++row) at[row] = row * count;
    return at;
}

// theta and theta_dot of all bodies, in document order, as state_hash has them.
template <class T> std::uint64_t hash_of(const MotionView<T>& view, std::size_t bodies) {
    Fnv hash;
    for (const T* quantity : {view.theta, view.theta_dot})
        for (std::size_t i = 0; i < bodies; ++i)
            for (std::size_t k = 0; k < 3; ++k) hash.add(quantity[view.at(i) + k * view.stride]);
    return hash.value();
}

template <class T>
void view_rows(const PlannedLanes<T>& planned, const RowVector<T>& rows, int theta_dot, MotionView<T>& view) {
    view.theta = rows.front().lane;
    view.theta_dot = view.theta + theta_dot * Row<T>::lanes;
    view.stride = view.lanes = Row<T>::lanes;
    view.slot = planned.layout.slot.data();
}

} // namespace

template <class T>
CoupledLanesStepper<T>::CoupledLanesStepper(Scheme scheme, Target target, double sleep)
    : Cloned<CoupledLanesStepper<T>, Stepper<T>>(std::string()), sleep_(sleep) {
    own.scheme = scheme;
    own.lanes.target = target;
}

template <class T> void CoupledLanesStepper<T>::lay_out(const Plan<T>& plan, const std::vector<TreeRange>& ranges) {
    gravity_ = plan.gravity;
    lay_out_lanes(plan, ranges, own.lanes);
    fill_coupled(plan, own);
    give_back(own.carried_moment, own.carried_drag);
    plan_sleep(plan, own, sleep_);
}

template <class T> void CoupledLanesStepper<T>::allocate(const Plan<T>& plan, State<T>& state) const {
    auto work = std::make_unique<CoupledLanesState<T>>();
    allocate_coupled(plan, state, *work, own.lanes.layout.ground.size());
    state.own = Copied<StepperState>(std::move(work));
}

template <class T>
void CoupledLanesStepper<T>::begin(const Plan<T>& plan, State<T>& state, const std::vector<Vector3<T>>& theta) const {
    CoupledLanesState<T>& work = coupled_work(state);
    update_kinematics(plan, state);
    pack(plan, own, state, work, theta);
    if (plan.pose) return;
    give_back(state.theta, state.theta_dot, work.theta_change, work.theta_dot_change); // present() makes them again
    work.lanes.presented = false;
}

template <class T> void CoupledLanesStepper<T>::advance(const Plan<T>& plan, State<T>& state, StageClock* clock) const {
    coupled_lanes_step(plan, own, state, coupled_work(state), clock);
}

template <class T> void CoupledLanesStepper<T>::present(const Plan<T>& plan, State<T>& state) const {
    CoupledLanesState<T>& work = coupled_work(state);
    if (work.lanes.presented) return;
    unpack(plan, own, state, work);
    work.lanes.presented = true;
    if (plan.pose) update_kinematics(plan, state);
}

template <class T> std::uint64_t CoupledLanesStepper<T>::hash(const Plan<T>& plan, const State<T>& state) const {
    MotionView<T> view;
    view_motion(plan, state, view);
    return hash_of(view, plan.bodies);
}

template <class T> bool CoupledLanesStepper<T>::known_finite(const State<T>& state) const {
    return coupled_work(state).lanes.finite;
}

template <class T> NonFinite CoupledLanesStepper<T>::non_finite(const State<T>& state) const {
    return non_finite_in_coupled(*first_non_finite(state));
}

template <class T> std::vector<CarriedArray<T>> CoupledLanesStepper<T>::carried(State<T>& state) const {
    return carried_by_coupled(state);
}

template <class T> void CoupledLanesStepper<T>::save(const Plan<T>&, const State<T>& state, SavedState& saved) const {
    saved.sleep = saved_sleep(own, coupled_work(state));
}

template <class T>
void CoupledLanesStepper<T>::restore(const Plan<T>&, State<T>& state, const SavedState& saved) const {
    if (own.lanes.sleep.on) restore_sleep(own, coupled_work(state), saved.sleep); // else what slept goes on awake
}

template <class T>
void CoupledLanesStepper<T>::view_motion(const Plan<T>&, const State<T>& state, MotionView<T>& view) const {
    static_assert(motion::theta == 0);
    const CoupledLanesState<T>& work = coupled_work(state);
    view_rows(own.lanes, work.lanes.table, motion::theta_dot, view);
    motion_of_rows(own, work, view.first);
}

template <class T>
void CoupledLanesStepper<T>::set_carried_moment(const Plan<T>&, std::size_t body, const Vec3& moment) {
    const Slot<T> row(own.lanes.constants, constant::count,
                      own.lanes.layout.slot[body]); // with /fracture none is shared
    row.put(constant::carried_moment, Vector3<T>(moment.template cast<T>()));
}

template <class T>
void CoupledLanesStepper<T>::drop(Plan<T>& plan, State<T>& state, const std::vector<std::size_t>& bodies) {
    CoupledLanesState<T>& work = coupled_work(state);
    for (const std::size_t i : bodies) drop_from_coupled(plan, state, i);
    std::vector<std::size_t> motion_at;
    motion_of_rows(own, work, motion_at);
    clear_lanes<T>(own.lanes, work.lanes.table, motion_at, constant::count, motion::count, put_pad<T>, bodies);
}

template <class T> void CoupledLanesStepper<T>::scale_wood(const Plan<T>&, T stiffness, T damping) {
    fast::scale_wood(own.lanes, stiffness, damping);
}

template <class T> void CoupledLanesStepper<T>::wake(const Plan<T>&, State<T>& state) const {
    wake_all(own, coupled_work(state));
}

template <class T>
AnalyticLanesStepper<T>::AnalyticLanesStepper(Target target, double sleep)
    : Cloned<AnalyticLanesStepper<T>, Stepper<T>>(std::string()) {
    own.lanes.target = target;
    if (sleep > 0) own.lanes.sleep.reason = "solver analytic";
}

template <class T> void AnalyticLanesStepper<T>::take_constants(const Plan<T>& plan, const Tree& tree) {
    take_analytic_constants(plan, tree, own);
}

template <class T> void AnalyticLanesStepper<T>::lay_out(const Plan<T>& plan, const std::vector<TreeRange>& ranges) {
    lay_out_lanes(plan, ranges, own.lanes);
    fill_analytic(plan, own);
    give_back(own.gravity_row, own.sway, own.joint_distance, own.com_distance, own.inverse_weight);
    if (!plan.pose) give_back(own.inertia_factor);
}

template <class T> void AnalyticLanesStepper<T>::allocate(const Plan<T>& plan, State<T>& state) const {
    auto work = std::make_unique<AnalyticLanesState<T>>();
    if (plan.pose) work->scaled_rate.assign(plan.bodies, Vector3<T>::Zero());
    if (plan.wind) state.wind = make_wind_table<T>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    state.own = Copied<StepperState>(std::move(work));
}

template <class T>
void AnalyticLanesStepper<T>::begin(const Plan<T>& plan, State<T>& state, const std::vector<Vector3<T>>& theta) const {
    AnalyticLanesState<T>& work = analytic_work(state);
    update_kinematics(plan, state);
    pack_analytic(plan, own, state, work, theta);
    if (plan.pose) return;
    give_back(state.theta, state.theta_dot, work.scaled_rate); // present() makes them again
    work.lanes.presented = false;
}

template <class T>
void AnalyticLanesStepper<T>::advance(const Plan<T>& plan, State<T>& state, StageClock* clock) const {
    analytic_lanes_step(plan, own, state, analytic_work(state), clock);
}

template <class T> void AnalyticLanesStepper<T>::present(const Plan<T>& plan, State<T>& state) const {
    AnalyticLanesState<T>& work = analytic_work(state);
    if (work.lanes.presented) return;
    unpack_analytic(plan, own, state, work);
    work.lanes.presented = true;
    if (plan.pose) update_kinematics(plan, state);
}

template <class T> std::uint64_t AnalyticLanesStepper<T>::hash(const Plan<T>& plan, const State<T>& state) const {
    MotionView<T> view;
    view_motion(plan, state, view);
    return hash_of(view, plan.bodies);
}

template <class T> bool AnalyticLanesStepper<T>::known_finite(const State<T>& state) const {
    return analytic_work(state).lanes.finite;
}

template <class T> NonFinite AnalyticLanesStepper<T>::non_finite(const State<T>& state) const {
    return non_finite_in_analytic(*first_non_finite(state));
}

template <class T> std::vector<CarriedArray<T>> AnalyticLanesStepper<T>::carried(State<T>& state) const {
    return {{"scaled_rate", &analytic_work(state).scaled_rate}};
}

template <class T>
void AnalyticLanesStepper<T>::view_motion(const Plan<T>&, const State<T>& state, MotionView<T>& view) const {
    static_assert(analytic::motion::theta == 0);
    view_rows(own.lanes, analytic_work(state).lanes.now, analytic::motion::theta_dot, view);
    view.first = even_rows(own.lanes.layout, analytic::motion::count);
}

template <class T>
void AnalyticLanesStepper<T>::drop(Plan<T>& plan, State<T>& state, const std::vector<std::size_t>& bodies) {
    for (const std::size_t i : bodies) drop_from_analytic(plan, state, i);
    clear_lanes<T>(own.lanes, analytic_work(state).lanes.now, even_rows(own.lanes.layout, analytic::motion::count),
                   analytic::constants(plan.wind), analytic::motion::count, put_analytic_pad<T>, bodies);
}

namespace {

constexpr const char* not_asked = "not asked for";

} // namespace

template <class T>
std::unique_ptr<Stepper<T>> coupled_stepper(const Scene& scene, Scheme scheme, std::optional<Target> simd,
                                            double sleep) {
    const std::string plainly = !simd                    ? not_asked
                                : scene.joint_limit      ? "/joint_limit"
                                : scheme_of(scheme).real ? std::string("scheme ") + scheme_of(scheme).name
                                                         : "";
    if (plainly.empty()) return std::make_unique<CoupledLanesStepper<T>>(scheme, *simd, sleep);
    return std::make_unique<CoupledStepper<T>>(scheme, plainly);
}

template <class T>
std::unique_ptr<Stepper<T>> analytic_stepper(const Scene& scene, std::optional<Target> simd, double sleep) {
    const char* const plainly = !simd                                         ? not_asked
                                : scene.joint_limit                           ? "/joint_limit"
                                : !scene.root_motion.empty()                  ? "/root_motion"
                                : scene.fictitious && lags(*scene.fictitious) ? "/fictitious"
                                                                              : "";
    if (*plainly == 0) return std::make_unique<AnalyticLanesStepper<T>>(*simd, sleep);
    return std::make_unique<AnalyticStepper<T>>(plainly);
}

template <class T> CoupledPlan<T>* coupled_plan(Plan<T>& plan) {
    if (auto* lanes = dynamic_cast<CoupledLanesStepper<T>*>(&*plan.stepper)) return &lanes->own;
    if (auto* plain = dynamic_cast<CoupledStepper<T>*>(&*plan.stepper)) return &plain->own;
    return nullptr;
}

template <class T> const PlannedLanes<T>* planned_lanes(const Plan<T>& plan) {
    if (const auto* coupled = dynamic_cast<const CoupledLanesStepper<T>*>(&*plan.stepper)) return &coupled->own.lanes;
    if (const auto* joints = dynamic_cast<const AnalyticLanesStepper<T>*>(&*plan.stepper)) return &joints->own.lanes;
    return nullptr;
}

template <class T> PlannedLanes<T>* planned_lanes(Plan<T>& plan) {
    return const_cast<PlannedLanes<T>*>(planned_lanes(static_cast<const Plan<T>&>(plan)));
}

template <class T> const Lanes<T>* lanes_of(const State<T>& state) {
    if (const auto* coupled = dynamic_cast<const CoupledLanesState<T>*>(&*state.own)) return &coupled->lanes;
    if (const auto* joints = dynamic_cast<const AnalyticLanesState<T>*>(&*state.own)) return &joints->lanes;
    return nullptr;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template class CoupledLanesStepper<T>;                                                                             \
    template class AnalyticLanesStepper<T>;                                                                            \
    template std::unique_ptr<Stepper<T>> coupled_stepper(const Scene&, Scheme, std::optional<Target>, double);         \
    template std::unique_ptr<Stepper<T>> analytic_stepper(const Scene&, std::optional<Target>, double);                \
    template CoupledPlan<T>* coupled_plan(Plan<T>&);                                                                   \
    template const PlannedLanes<T>* planned_lanes(const Plan<T>&);                                                     \
    template PlannedLanes<T>* planned_lanes(Plan<T>&);                                                                 \
    template const Lanes<T>* lanes_of(const State<T>&);
BOUGH_INSTANTIATE(float)
BOUGH_INSTANTIATE(double)
#undef BOUGH_INSTANTIATE

} // namespace bough::fast
