// analytic_stepper.h: the analytic solver's plain path as a run's stepper: analytic_step.h, one joint at a time.
#pragma once
#include "../plan/plain_stepper.h"
#include "analytic_constants.h"

namespace bough {

// Throws std::domain_error for what the analytic solver cannot hold: pulls that turn with their bodies.
void refuse_with_analytic(const Scene&);

template <class T> class AnalyticStepper final : public Cloned<AnalyticStepper<T>, PlainStepper<T>, Stepper<T>> {
public:
    // plainly: why the steps are not made in lanes.
    AnalyticStepper(const Scene&, std::string plainly);
    void refuse(const Scene& scene) const override { refuse_with_analytic(scene); }
    void take_constants(const Plan<T>& plan, const Tree& tree) override { take_analytic_constants(plan, tree, own); }
    void explain(const Plan<T>&, PlanAccount&) const override;
    void allocate(const Plan<T>&, State<T>&) const override;
    void begin(const Plan<T>&, State<T>&, const std::vector<Vector3<T>>& theta) const override;
    void advance(const Plan<T>&, State<T>&, StageClock*) const override;
    std::optional<NonFinite> non_finite(const Plan<T>&, State<T>&) const override;
    std::vector<CarriedArray<T>> carried(State<T>&) const override;
    const std::vector<Vector3<T>>& inertia_factor() const override { return own.inertia_factor; }
    void save(const State<T>&, SavedState&) const override;
    void restore(State<T>&, const SavedState&) const override;
    void drop(Plan<T>&, State<T>&, const std::vector<std::size_t>& bodies, const std::vector<CarriedMoment>&) override;

    AnalyticPlan<T> own;
};

// In the analytic solver a body that is none has an inertia [kg m^2] whose eigenvalues can be found, and a spring neither soft nor stiff over any
// step. So nothing takes a case for it that the bodies beside it do not need. Nothing bends it, and its motion stays 0.
template <class T> constexpr T pad_inertia = sizeof(T) == 4 ? T(1e-20) : T(1e-40);
template <class T> constexpr T pad_rate2 = T(1e4); // [1/s^2] K over inertia

// Leaves these values to a body that broke off.
template <class T> void drop_from_analytic(Plan<T>&, State<T>&, std::size_t body);

// Returns the own part of a state of the analytic solver.
template <class T> AnalyticState<T>& analytic_state(State<T>& state) {
    return static_cast<AnalyticState<T>&>(*state.own);
}
template <class T> const AnalyticState<T>& analytic_state(const State<T>& state) {
    return static_cast<const AnalyticState<T>&>(*state.own);
}

} // namespace bough
