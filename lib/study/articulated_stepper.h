// articulated_stepper.h: the articulated solvers, which others are held against, as a run's stepper, in double alone.
//
// explicit-euler  articulated_step.h, Euler forward
// implicit-euler  articulated_step.h, linearly implicit
// extrapolation   extrapolation.h, to a tolerance
#pragma once
#include "../plan/plain_stepper.h"
#include "articulated_pass.h"

namespace bough {

class ArticulatedStepper final : public Cloned<ArticulatedStepper, PlainStepper<double>, Stepper<double>> {
public:
    // name: as in --solver. plainly: why it is not in lanes.
    ArticulatedStepper(ArticulatedMethod, const char* name, std::string plainly);
    void refuse(const Scene&) const override; // joint limits, what is free, lagged terms
    void take_constants(const Plan<double>&, const Tree&) override;
    void explain(const Plan<double>&, PlanAccount&) const override;
    void allocate(const Plan<double>&, State<double>&) const override;
    void advance(const Plan<double>&, State<double>&, StageClock*) const override;
    std::vector<CarriedArray<double>> carried(State<double>&) const override;
    void save(const State<double>&, SavedState&) const override;
    void restore(State<double>&, const SavedState&) const override;
    void drop(Plan<double>&, State<double>&, const std::vector<std::size_t>&,
              const std::vector<CarriedMoment>&) override; // never: nothing is free

    ArticulatedPlan own;
};

// Of a state of an articulated solver.
inline ArticulatedState& articulated_state(State<double>& state) {
    return static_cast<ArticulatedState&>(*state.own);
}
inline const ArticulatedState& articulated_state(const State<double>& state) {
    return static_cast<const ArticulatedState&>(*state.own);
}

} // namespace bough
