// stability_free.h: one cell of the grid of extremes (stability.h) whose scene has free bodies.
//
// Judged by finite numbers and, with the coupled step, by energy: kinetic, elastic and potential of the trees and of all that is free
// never above what they were at the start, and what pushing overlaps apart lifted, by more than 1 % of the largest kinetic energy so far: contacts,
// friction, breaking and air take energy alone.
// With the analytic step, whose oscillators' energy is not the bodies', by nothing free being ten times as fast as balls were or a fall makes it.
#pragma once
#include "solvers.h"
#include "stability_cases.h"
#include "stability_cell.h"
#include <functional>

namespace bough {

// Throws what make_plan and make_world throw.
void run_free_cell(const StabilitySetup&, Solver, bool single, std::int64_t frames, const std::function<void()>& tick,
                   StabilityCell& cell);

} // namespace bough
