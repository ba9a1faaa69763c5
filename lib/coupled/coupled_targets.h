// coupled_targets.h: the coupled step's sweeps as they are compiled for a SIMD target.
#pragma once
#include "../lanes/target.h"
#include "coupled_sweeps.h"
#include "energy_sweep.h"

namespace bough::fast {

// Returns the code of the target, which must be available.
template <class T> CoupledSweeps<T> coupled_sweeps_for(Target, SweepLoads);
template <class T> EnergySweepOf<T> energy_sweep_for(Target, SweepLoads);

} // namespace bough::fast
