#include "analytic_lanes_stepper.h"
#include "../lanes/clear_lanes.h"
#include "../lanes/lane_motion.h"
#include "../lanes/plan_lanes.h"
#include "../laws/wind.h"
#include "analytic_lanes_step.h"
#include "analytic_rows.h"
#include "analytic_stepper.h"
#include "fictitious.h"

namespace bough::fast {
namespace {

template <class T> AnalyticLanesState<T>& analytic_work(State<T>& state) {
    return static_cast<AnalyticLanesState<T>&>(*state.own);
}
template <class T> const AnalyticLanesState<T>& analytic_work(const State<T>& state) {
    return static_cast<const AnalyticLanesState<T>&>(*state.own);
}

} // namespace

template <class T>
AnalyticLanesStepper<T>::AnalyticLanesStepper(Target target, double sleep)
    : Cloned<AnalyticLanesStepper<T>, LanesStepper<T>, Stepper<T>>(
          StepperKind{.name = "analytic", .plainly = {}, .stage = Stage::spring}) {
    own.lanes.target = target;
    if (sleep > 0) own.lanes.sleep.reason = "solver analytic";
}

template <class T> void AnalyticLanesStepper<T>::refuse(const Scene& scene) const {
    refuse_with_analytic(scene);
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

template <class T> Lanes<T>& AnalyticLanesStepper<T>::lanes_of(State<T>& state) const {
    return analytic_work(state).lanes;
}

template <class T>
void AnalyticLanesStepper<T>::pack_rows(const Plan<T>& plan, State<T>& state,
                                        const std::vector<Vector3<T>>& theta) const {
    pack_analytic(plan, own, state, analytic_work(state), theta);
}

template <class T> void AnalyticLanesStepper<T>::unpack_rows(const Plan<T>& plan, State<T>& state) const {
    unpack_analytic(plan, own, state, analytic_work(state));
}

template <class T>
void AnalyticLanesStepper<T>::advance(const Plan<T>& plan, State<T>& state, StageClock* clock) const {
    analytic_lanes_step(plan, own, state, analytic_work(state), clock);
}

template <class T> std::vector<CarriedArray<T>> AnalyticLanesStepper<T>::carried(State<T>& state) const {
    return {{"scaled_rate", &analytic_work(state).scaled_rate}};
}

template <class T> void AnalyticLanesStepper<T>::view_motion(const State<T>& state, MotionView<T>& view) const {
    static_assert(analytic::motion::theta == 0);
    view_rows(own.lanes, analytic_work(state).lanes.now, analytic::motion::theta_dot, view);
    view.first = even_rows(own.lanes.layout, analytic::motion::count);
}

template <class T>
void AnalyticLanesStepper<T>::drop(Plan<T>& plan, State<T>& state, const std::vector<std::size_t>& bodies,
                                   const std::vector<CarriedMoment>&) {
    for (const std::size_t i : bodies) drop_from_analytic(plan, state, i);
    clear_lanes<T>(own.lanes, analytic_work(state).lanes.now, even_rows(own.lanes.layout, analytic::motion::count),
                   analytic::constants(plan.wind), analytic::motion::count, put_analytic_pad<T>, bodies);
}

template <class T>
std::unique_ptr<Stepper<T>> analytic_stepper(const Scene& scene, std::optional<Target> simd, double sleep) {
    const char* const plainly = !simd && !best_target()      ? "none of this build's SIMD code runs on this machine"
                                : !simd                      ? "not asked for"
                                : scene.joint_limit          ? "/joint_limit"
                                : !scene.root_motion.empty() ? "/root_motion"
                                : !scene.attachments.empty() ? "/attachments"
                                : scene.fictitious && lags(*scene.fictitious) ? "/fictitious"
                                                                              : "";
    if (*plainly == 0) return std::make_unique<AnalyticLanesStepper<T>>(*simd, sleep);
    return std::make_unique<AnalyticStepper<T>>(scene, plainly);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template class AnalyticLanesStepper<T>;                                                                            \
    template std::unique_ptr<Stepper<T>> analytic_stepper(const Scene&, std::optional<Target>, double);
#include "../base/instantiate.inc"

} // namespace bough::fast
