// analytic_targets.h: the analytic step's sweeps as they are compiled for a SIMD target.
#pragma once
#include "../lanes/target.h"
#include "analytic_sweeps.h"

namespace bough::fast {

// Returns the code of the target, which must be available.
template <class T> AnalyticSweeps<T> analytic_sweeps_for(Target, SweepLoads);

} // namespace bough::fast
