// analytic_lanes_stepper.h: the analytic solver with its steps made in lanes, as a run's stepper.
#pragma once
#include "../lanes/lanes_stepper.h"
#include "analytic_lanes_state.h"

namespace bough::fast {

// The scene must be without joint limits, moved roots and /fictitious.
template <class T>
class AnalyticLanesStepper final : public Cloned<AnalyticLanesStepper<T>, LanesStepper<T>, Stepper<T>> {
public:
    AnalyticLanesStepper(Target, double sleep); // sleep: is not for it, which the plan says where it was asked for
    void refuse(const Scene&) const override;
    void take_constants(const Plan<T>&, const Tree&) override;
    void lay_out(const Plan<T>&, const std::vector<TreeRange>&) override;
    void explain(const Plan<T>&, PlanAccount&) const override;
    void allocate(const Plan<T>&, State<T>&) const override;
    void advance(const Plan<T>&, State<T>&, StageClock*) const override;
    std::vector<CarriedArray<T>> carried(State<T>&) const override;
    void view_motion(const State<T>&, MotionView<T>&) const override;
    const std::vector<Vector3<T>>& inertia_factor() const override { return own.inertia_factor; }
    void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies, const std::vector<CarriedMoment>&) override;
    const PlannedLanes<T>& lanes() const override { return own.lanes; }

    AnalyticLanesPlan<T> own;

private:
    Lanes<T>& lanes_of(State<T>&) const override;
    void pack_rows(const Plan<T>&, State<T>&, const std::vector<Vector3<T>>& theta) const override;
    void unpack_rows(const Plan<T>&, State<T>&) const override;
};

// Makes the solver for a scene. Its steps are in lanes of that target if one is asked for and the lanes hold all that the scene has; else they are
// plain (StepperKind::plainly says why). sleep: [rad/s] as above.
template <class T> std::unique_ptr<Stepper<T>> analytic_stepper(const Scene&, std::optional<Target>, double sleep = 0);

} // namespace bough::fast
