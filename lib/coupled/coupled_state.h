// coupled_state.h: the coupled solver's own part of plan and state: constants, what it carries from step to step, what a step works in.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"
#include "attachment_state.h"
#include "coupled_body.h"
#include "scheme.h"
#include <complex>

namespace bough {

template <class T> struct CoupledPlan {
    Scheme scheme = Scheme::p12;
    std::vector<Vector3<T>> carried_moment; // [kg m] P of body_load.h, body axes; with gravity
    std::vector<Vector3<T>> carried_drag;   // [kg] likewise of kappa rho A; with wind alone
};

// The part of the state that is the same whether the step is made plainly or in lanes.
template <class T> struct CoupledState : StepperState {
    std::vector<Vector3<T>> theta_change, theta_dot_change; // of the last step; carried, saved
    std::vector<EnergyAccount> account;                     // one a root
    WindTable<T> wind_change;                               // [m/s] of the wind over the step
    WindField<T> wind_start, wind_end; // where it varies over the ground: at the step's start and end
    std::vector<GroundStep<T>> ground; // of each of the plan's splines
    Attachments attachments;
};

// The plain step's part: records of bodies.
template <class T> struct CoupledWork : Cloned<CoupledWork<T>, CoupledState<T>, StepperState> {
    std::vector<CoupledBody<T>> coupled;
    std::vector<ResolventBody<std::complex<T>>> resolvent;
    std::vector<ResolventBody<T>> resolvent_real; // of a scheme of a real pole; with joint limits
    std::vector<GuardBody<T>> guard;

    std::size_t bytes() const override;
};

// Fills in the constants of `own`, for Stepper::take_constants. O(n).
template <class T> void take_coupled_constants(const Plan<T>&, const Tree&, CoupledPlan<T>& own);

// Allocates all of a state that both ways have. roots: how many the trees have.
template <class T> void allocate_coupled(const Plan<T>&, State<T>&, CoupledState<T>& own, std::size_t roots);

// Throws std::domain_error for what the coupled solver cannot hold.
void refuse_with_coupled(const Scene&);

} // namespace bough
