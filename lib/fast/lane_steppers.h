// lane_steppers.h: the coupled and the analytic solver with their steps made in lanes, as a run's steppers.
#pragma once
#include "lane_states.h"

namespace bough::fast {

template <class T> class CoupledLanesStepper final : public Cloned<CoupledLanesStepper<T>, Stepper<T>> {
public:
    // sleep: [rad/s] the rate below which what has settled is left out of steps (sleep.h); 0: never. The scheme is of complex poles, the scene without
    // joint limits.
    CoupledLanesStepper(Scheme, Target, double sleep);
    const char* name() const override { return "coupled"; }
    const char* scheme() const override { return scheme_of(own.scheme).name; }
    void refuse(const Scene& scene) const override { refuse_with_coupled(scene); }
    void take_constants(const Plan<T>& plan, const Tree& tree) override { take_coupled_constants(plan, tree, own); }
    void lay_out(const Plan<T>&, const std::vector<TreeRange>&) override;
    void allocate(const Plan<T>&, State<T>&) const override;
    void begin(const Plan<T>&, State<T>&, const std::vector<Vector3<T>>& theta) const override;
    void advance(const Plan<T>&, State<T>&, StageClock*) const override;
    void present(const Plan<T>&, State<T>&) const override;
    std::uint64_t hash(const Plan<T>&, const State<T>&) const override;
    bool known_finite(const State<T>&) const override;
    NonFinite non_finite(const State<T>&) const override;
    std::vector<CarriedArray<T>> carried(State<T>&) const override;
    void save(const Plan<T>&, const State<T>&, SavedState&) const override;
    void restore(const Plan<T>&, State<T>&, const SavedState&) const override;
    void view_motion(const Plan<T>&, const State<T>&, MotionView<T>&) const override;
    bool has_carried_moments() const override { return gravity_; }
    void set_carried_moment(const Plan<T>&, std::size_t body, const Vec3&) override;
    void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies) override;
    void scale_wood(const Plan<T>&, T stiffness, T damping) override;
    bool sleeps() const override { return own.lanes.sleep.on; }
    void wake(const Plan<T>&, State<T>&) const override;

    CoupledLanesPlan<T> own;

private:
    double sleep_;
    bool gravity_ = false;
};

// The scene is without joint limits, moved roots and /fictitious.
template <class T> class AnalyticLanesStepper final : public Cloned<AnalyticLanesStepper<T>, Stepper<T>> {
public:
    AnalyticLanesStepper(Target, double sleep); // sleep: is not for it, which the plan says where it was asked for
    const char* name() const override { return "analytic"; }
    void take_constants(const Plan<T>&, const Tree&) override;
    void lay_out(const Plan<T>&, const std::vector<TreeRange>&) override;
    void allocate(const Plan<T>&, State<T>&) const override;
    void begin(const Plan<T>&, State<T>&, const std::vector<Vector3<T>>& theta) const override;
    void advance(const Plan<T>&, State<T>&, StageClock*) const override;
    void present(const Plan<T>&, State<T>&) const override;
    std::uint64_t hash(const Plan<T>&, const State<T>&) const override;
    bool known_finite(const State<T>&) const override;
    NonFinite non_finite(const State<T>&) const override;
    std::vector<CarriedArray<T>> carried(State<T>&) const override;
    void view_motion(const Plan<T>&, const State<T>&, MotionView<T>&) const override;
    const std::vector<Vector3<T>>& inertia_factor() const override { return own.inertia_factor; }
    void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies) override;

    AnalyticLanesPlan<T> own;
};

// The solver on a scene, with its steps in lanes of that target where it is asked for and they hold all that the scene has, else plainly
// (Stepper::plainly says why). sleep: [rad/s] as above.
template <class T>
std::unique_ptr<Stepper<T>> coupled_stepper(const Scene&, Scheme, std::optional<Target>, double sleep = 0);
template <class T> std::unique_ptr<Stepper<T>> analytic_stepper(const Scene&, std::optional<Target>, double sleep = 0);

// Of a plan of the coupled solver, whichever way its steps are made; null for another.
template <class T> CoupledPlan<T>* coupled_plan(Plan<T>&);
template <class T> const CoupledPlan<T>* coupled_plan(const Plan<T>& plan) {
    return coupled_plan(const_cast<Plan<T>&>(plan));
}

// Of a plan in lanes; null where it is on the plain path.
template <class T> const PlannedLanes<T>* planned_lanes(const Plan<T>&);
template <class T> PlannedLanes<T>* planned_lanes(Plan<T>&);
// Of a state of such a plan; null likewise.
template <class T> const Lanes<T>* lanes_of(const State<T>&);

} // namespace bough::fast
