// advance.h: one step with the solver that the plan names.
//
// coupled               coupled_step.h: the full dynamics, one linear solve a step
// analytic              step.h: the paper's, one joint at a time
// articulated_explicit  articulated_step.h, Euler forward
// articulated_implicit  articulated_step.h, linearly implicit
// articulated_reference extrapolation.h, to the plan's tolerance
// Needs a state of this plan with kinematics up to date; leaves one, but where the plan has lanes: there present() does. The
// articulated solvers exist in double alone: std::logic_error in float.
#pragma once
#include "../fast/present.h"
#include "../stages/step.h"

namespace bough {

template <class T> void advance(const Plan<T>&, State<T>&, StageClock* clock = nullptr);

} // namespace bough
