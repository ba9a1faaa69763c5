// coupled_stepper.h: the coupled solver's plain path as a run's stepper: coupled_step.h, one number at a time.
#pragma once
#include "../plan/plain_stepper.h"
#include "coupled_state.h"

namespace bough {

// Multiplies the last step's changes, in arrays in document order, by ratio.
template <class T> void scale_changes(State<T>&, T ratio);

template <class T> class CoupledStepper final : public Cloned<CoupledStepper<T>, PlainStepper<T>, Stepper<T>> {
public:
    // plainly: why the steps are not made in lanes.
    CoupledStepper(Scheme, std::string plainly);
    const char* name() const override { return "coupled"; }
    const char* scheme() const override { return scheme_of(own.scheme).name; }
    void refuse(const Scene& scene) const override { refuse_with_coupled(scene); }
    void take_constants(const Plan<T>& plan, const Tree& tree) override { take_coupled_constants(plan, tree, own); }
    void allocate(const Plan<T>&, State<T>&) const override;
    void advance(const Plan<T>&, State<T>&, StageClock*) const override;
    NonFinite non_finite(const State<T>&) const override;
    std::vector<CarriedArray<T>> carried(State<T>&) const override;
    void save(const Plan<T>&, const State<T>&, SavedState&) const override;
    void restore(const Plan<T>&, State<T>&, const SavedState&) const override;
    bool has_carried_moments() const override { return !own.carried_moment.empty(); }
    void set_carried_moment(const Plan<T>&, std::size_t body, const Vec3& moment) override {
        own.carried_moment[body] = moment.template cast<T>();
    }
    void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies) override;
    void step_changed(const Plan<T>&, State<T>& state, T ratio) override { scale_changes(state, ratio); }

    CoupledPlan<T> own;
};

// Returns the changes that the coupled solver carries, whichever way its steps are made.
template <class T> std::vector<CarriedArray<T>> carried_by_coupled(State<T>&);
NonFinite non_finite_in_coupled(std::size_t body);

// Leaves a body that broke off without mass, inertia and motion, on a spring that is never bent; for either way of the coupled solver.
template <class T> void drop_from_coupled(Plan<T>&, State<T>&, std::size_t body);

// Returns the own part of a state of the coupled solver.
template <class T> CoupledState<T>& coupled_state(State<T>& state) {
    return static_cast<CoupledState<T>&>(*state.own);
}
template <class T> const CoupledState<T>& coupled_state(const State<T>& state) {
    return static_cast<const CoupledState<T>&>(*state.own);
}

} // namespace bough
