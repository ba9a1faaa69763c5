// targets.h: which of the compiled SIMD targets a run uses: chosen when the program starts, by what the machine has.
#pragma once
#include "analytic_sweeps.h"
#include "coupled_sweeps.h"
#include "energy_sweep.h"
#include "target.h"

namespace bough::fast {

// The target's code, which must be available.
template <class T> CoupledSweeps<T> coupled_sweeps_for(Target, bool wind, bool gravity, bool field);
template <class T> EnergySweepOf<T> energy_sweep_for(Target, bool wind, bool field);
template <class T> AnalyticSweeps<T> analytic_sweeps_for(Target, AnalyticLoads);

} // namespace bough::fast
