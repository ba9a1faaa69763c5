// articulated_step.h: the low-order steps of the full articulated dynamics (articulated.h).
//
// explicit    Euler's forward step, the paper's yardstick: rate += h rate', theta += h T rate. Stable only where h is below
//             about 2 / (beta omega^2) of the fastest joint: nanoseconds for a stiff tree.
// implicit    linearly implicit Euler: articulated.h with h, then rate += h rate', theta += h T rate_1. First order, stable
//             for any stiffness and damping; it damps what it cannot resolve.
// time: of the start. Implicit takes the loads at the end.
// Reads and writes theta, rate of pass.body. O(n), one pass. Errors none.
#pragma once
#include "articulated.h"

namespace bough {

void explicit_euler(const Plan<double>&, ArticulatedPass&, double time, double h);
void implicit_euler(const Plan<double>&, ArticulatedPass&, double time, double h);

} // namespace bough
