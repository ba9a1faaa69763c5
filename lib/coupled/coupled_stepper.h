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
    void refuse(const Scene& scene) const override { refuse_with_coupled(scene); }
    void take_constants(const Plan<T>&, const Tree&) override;
    void explain(const Plan<T>&, PlanAccount&) const override;
    void allocate(const Plan<T>&, State<T>&) const override;
    void advance(const Plan<T>&, State<T>&, StageClock*) const override;
    std::vector<CarriedArray<T>> carried(State<T>&) const override;
    void save(const State<T>&, SavedState&) const override;
    void restore(State<T>&, const SavedState&) const override;
    void change(const Plan<T>&, State<T>& state, const StepperChange<T>& change) override {
        scale_changes(state, change.step);
    }
    void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies,
              const std::vector<CarriedMoment>& carried) override;

    CoupledPlan<T> own;
};

// Returns the changes that the coupled solver carries, whichever way its steps are made.
template <class T> std::vector<CarriedArray<T>> carried_by_coupled(State<T>&);

// Returns what a stepper of the coupled solver is.
StepperKind coupled_kind(Scheme, std::string plainly);

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
