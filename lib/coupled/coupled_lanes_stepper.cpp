#include "coupled_lanes_stepper.h"
#include "../lanes/clear_lanes.h"
#include "../lanes/lane_motion.h"
#include "../lanes/plan_lanes.h"
#include "../plan/attachment_course.h"
#include "attachment.h"
#include "attachment_lanes.h"
#include "coupled_lanes_step.h"
#include "coupled_stepper.h"
#include "coupled_tables.h"
#include "sleep.h"
#include <utility>

namespace bough::fast {
namespace {

template <class T> CoupledLanesState<T>& coupled_work(State<T>& state) {
    return static_cast<CoupledLanesState<T>&>(*state.own);
}
template <class T> const CoupledLanesState<T>& coupled_work(const State<T>& state) {
    return static_cast<const CoupledLanesState<T>&>(*state.own);
}

} // namespace

template <class T>
CoupledLanesStepper<T>::CoupledLanesStepper(Scheme scheme, Target target, double sleep)
    : Cloned<CoupledLanesStepper<T>, LanesStepper<T>, Stepper<T>>(coupled_kind(scheme, {})), sleep_(sleep) {
    own.scheme = scheme;
    own.lanes.target = target;
}

template <class T> void CoupledLanesStepper<T>::take_constants(const Plan<T>& plan, const Tree& tree) {
    take_coupled_constants(plan, tree, own);
    this->carries_moments_ = plan.gravity;
}

template <class T> void CoupledLanesStepper<T>::lay_out(const Plan<T>& plan, const std::vector<TreeRange>& ranges) {
    lay_out_lanes(plan, ranges, own.lanes);
    // Between the sweeps inward and outward ties are solved for, for which all trees wait.
    if (plan.pairs || !plan.followers.empty())
        for (Block& block : own.lanes.layout.blocks) block.whole = false;
    fill_coupled(plan, own);
    give_back(own.carried_moment, own.carried_drag);
    plan_sleep(plan, own, sleep_);
}

template <class T> void CoupledLanesStepper<T>::allocate(const Plan<T>& plan, State<T>& state) const {
    auto work = std::make_unique<CoupledLanesState<T>>();
    allocate_coupled(plan, state, *work, own.lanes.layout.ground.size());
    begin_attachments(plan, *work);
    if (work->attachments.any()) place_attached_rows(own, *work);
    state.own = Copied<StepperState>(std::move(work));
}

template <class T> Lanes<T>& CoupledLanesStepper<T>::lanes_of(State<T>& state) const {
    return coupled_work(state).lanes;
}

template <class T>
void CoupledLanesStepper<T>::pack_rows(const Plan<T>& plan, State<T>& state,
                                       const std::vector<Vector3<T>>& theta) const {
    pack(plan, own, state, coupled_work(state), theta);
}

template <class T> void CoupledLanesStepper<T>::unpack_rows(const Plan<T>& plan, State<T>& state) const {
    unpack(plan, own, state, coupled_work(state));
}

template <class T> void CoupledLanesStepper<T>::advance(const Plan<T>& plan, State<T>& state, StageClock* clock) const {
    coupled_lanes_step(plan, own, state, coupled_work(state), clock);
}

template <class T> std::vector<CarriedArray<T>> CoupledLanesStepper<T>::carried(State<T>& state) const {
    return carried_by_coupled(state);
}

template <class T> void CoupledLanesStepper<T>::save(const State<T>& state, SavedState& saved) const {
    saved.sleep = saved_sleep(own, coupled_work(state));
    saved.attachments = saved_attachments(coupled_work(state).attachments.all);
}

template <class T> void CoupledLanesStepper<T>::restore(State<T>& state, const SavedState& saved) const {
    restore_attachments(coupled_work(state).attachments.all, saved.attachments);
    if (own.lanes.sleep.on) restore_sleep(own, coupled_work(state), saved.sleep); // else what slept goes on awake
}

template <class T> void CoupledLanesStepper<T>::view_motion(const State<T>& state, MotionView<T>& view) const {
    static_assert(motion::theta == 0);
    const CoupledLanesState<T>& work = coupled_work(state);
    view_rows(own.lanes, work.lanes.table, motion::theta_dot, view);
    motion_of_rows(own, work, view.first);
}

template <class T>
void CoupledLanesStepper<T>::drop(Plan<T>& plan, State<T>& state, const std::vector<std::size_t>& bodies,
                                  const std::vector<CarriedMoment>& carried) {
    CoupledLanesState<T>& work = coupled_work(state);
    for (const CarriedMoment& left : carried) {
        const Slot<T> row(own.lanes.constants, constant::count,
                          own.lanes.layout.slot[left.body]); // with /fracture none is shared
        row.put(constant::carried_moment, Vector3<T>(left.moment.template cast<T>()));
    }
    for (const std::size_t i : bodies) drop_from_coupled(plan, state, i);
    release_from(plan, work, bodies);
    if (work.attachments.any() || !work.attached.of_row.empty()) place_attached_rows(own, work);
    std::vector<std::size_t> motion_at;
    motion_of_rows(own, work, motion_at);
    clear_lanes<T>(own.lanes, work.lanes.table, motion_at, constant::count, motion::count, put_pad<T>, bodies);
}

template <class T>
void CoupledLanesStepper<T>::change(const Plan<T>& plan, State<T>& state, const StepperChange<T>& change) {
    CoupledLanesState<T>& work = coupled_work(state);
    if (change.stiffness != 1 || change.damping != 1) scale_wood(own.lanes, change.stiffness, change.damping);
    if (change.step != 1) fast::scale_changes(own, work, change.step);
    if (work.lanes.presented) bough::scale_changes(state, change.step);
    if (change.attachments) place_attached_rows(own, work);
    own.lanes.sleep.steps = steps_to_settle(plan.dt);
    if (change.wake) wake_all(own, work);
}

template <class T>
std::unique_ptr<Stepper<T>> coupled_stepper(const Scene& scene, Scheme scheme, std::optional<Target> simd,
                                            double sleep) {
    const std::string plainly = !simd && !best_target()  ? "none of this build's SIMD code runs on this machine"
                                : !simd                  ? "not asked for"
                                : scene.joint_limit      ? "/joint_limit"
                                : scheme_of(scheme).real ? std::string("scheme ") + scheme_of(scheme).name
                                                         : "";
    if (plainly.empty()) return std::make_unique<CoupledLanesStepper<T>>(scheme, *simd, sleep);
    return std::make_unique<CoupledStepper<T>>(scheme, plainly);
}

template <class T> const CoupledPlan<T>* coupled_plan(const Plan<T>& plan) {
    if (const auto* lanes = dynamic_cast<const CoupledLanesStepper<T>*>(&*plan.stepper)) return &lanes->own;
    if (const auto* plain = dynamic_cast<const CoupledStepper<T>*>(&*plan.stepper)) return &plain->own;
    return nullptr;
}

template <class T> CoupledPlan<T>* coupled_plan(Plan<T>& plan) {
    return const_cast<CoupledPlan<T>*>(coupled_plan(std::as_const(plan))); // the plan is the caller's to change
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template class CoupledLanesStepper<T>;                                                                             \
    template std::unique_ptr<Stepper<T>> coupled_stepper(const Scene&, Scheme, std::optional<Target>, double);         \
    template const CoupledPlan<T>* coupled_plan(const Plan<T>&);                                                       \
    template CoupledPlan<T>* coupled_plan(Plan<T>&);
#include "../base/instantiate.inc"

} // namespace bough::fast
