// coupled_lanes_stepper.h: the coupled solver with its steps made in lanes, as a run's stepper.
#pragma once
#include "../lanes/lanes_stepper.h"
#include "coupled_lanes_state.h"

namespace bough::fast {

template <class T>
class CoupledLanesStepper final : public Cloned<CoupledLanesStepper<T>, LanesStepper<T>, Stepper<T>> {
public:
    // sleep: [rad/s] the rate below which what has settled is left out of steps (sleep.h); 0: never. The scheme must have complex poles, and the
    // scene no joint limits.
    CoupledLanesStepper(Scheme, Target, double sleep);
    void refuse(const Scene& scene) const override { refuse_with_coupled(scene); }
    void take_constants(const Plan<T>&, const Tree&) override;
    void lay_out(const Plan<T>&, const std::vector<TreeRange>&) override;
    void explain(const Plan<T>&, PlanAccount&) const override;
    void allocate(const Plan<T>&, State<T>&) const override;
    void advance(const Plan<T>&, State<T>&, StageClock*) const override;
    std::vector<CarriedArray<T>> carried(State<T>&) const override;
    void save(const State<T>&, SavedState&) const override;
    void restore(State<T>&, const SavedState&) const override;
    void change(const Plan<T>&, State<T>&, const StepperChange<T>&) override;
    void view_motion(const State<T>&, MotionView<T>&) const override;
    void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies,
              const std::vector<CarriedMoment>& carried) override;
    const PlannedLanes<T>& lanes() const override { return own.lanes; }

    CoupledLanesPlan<T> own;

private:
    Lanes<T>& lanes_of(State<T>&) const override;
    void pack_rows(const Plan<T>&, State<T>&, const std::vector<Vector3<T>>& theta) const override;
    void unpack_rows(const Plan<T>&, State<T>&) const override;

    double sleep_;
};

// Makes the solver for a scene. Its steps are in lanes of that target if one is asked for and the lanes hold all that the scene has; else they are
// plain (StepperKind::plainly says why). sleep: [rad/s] as above.
template <class T>
std::unique_ptr<Stepper<T>> coupled_stepper(const Scene&, Scheme, std::optional<Target>, double sleep = 0);

// Returns the coupled solver's part of a plan, whichever way its steps are made; null for another solver.
template <class T> CoupledPlan<T>* coupled_plan(Plan<T>&);
template <class T> const CoupledPlan<T>* coupled_plan(const Plan<T>&);

} // namespace bough::fast
