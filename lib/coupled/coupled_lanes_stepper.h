// coupled_lanes_stepper.h: the coupled solver with its steps made in lanes, as a run's stepper.
#pragma once
#include "coupled_lanes_state.h"

namespace bough::fast {

template <class T> class CoupledLanesStepper final : public Cloned<CoupledLanesStepper<T>, Stepper<T>> {
public:
    // sleep: [rad/s] the rate below which what has settled is left out of steps (sleep.h); 0: never. The scheme must have complex poles, and the
    // scene no joint limits.
    CoupledLanesStepper(Scheme, Target, double sleep);
    const char* name() const override { return "coupled"; }
    const char* scheme() const override { return scheme_of(own.scheme).name; }
    void refuse(const Scene& scene) const override { refuse_with_coupled(scene); }
    bool places_points() const override { return true; } // pulled_points.h, attachment.h
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
    void step_changed(const Plan<T>&, State<T>&, T ratio) override;
    bool sleeps() const override { return own.lanes.sleep.on; }
    void wake(const Plan<T>&, State<T>&) const override;
    void attachments_changed(State<T>&) const override;
    const PlannedLanes<T>* lanes() const override { return &own.lanes; }

    CoupledLanesPlan<T> own;

private:
    double sleep_;
    bool gravity_ = false;
};

// Makes the solver for a scene. Its steps are in lanes of that target if one is asked for and the lanes hold all that the scene has; else they are
// plain (Stepper::plainly says why). sleep: [rad/s] as above.
template <class T>
std::unique_ptr<Stepper<T>> coupled_stepper(const Scene&, Scheme, std::optional<Target>, double sleep = 0);

// Returns the coupled solver's part of a plan, whichever way its steps are made; null for another solver.
template <class T> CoupledPlan<T>* coupled_plan(Plan<T>&);
template <class T> const CoupledPlan<T>* coupled_plan(const Plan<T>& plan) {
    return coupled_plan(const_cast<Plan<T>&>(plan));
}

} // namespace bough::fast
