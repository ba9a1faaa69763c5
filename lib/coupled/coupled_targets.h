// coupled_targets.h: the coupled step's sweeps as they are compiled for a SIMD target.
#pragma once
#include "../lanes/target.h"
#include "coupled_sweeps.h"
#include "energy_sweep.h"

namespace bough::fast {

// The target's code, which must be available.
template <class T> CoupledSweeps<T> coupled_sweeps_for(Target, bool wind, bool gravity, bool field);
template <class T> EnergySweepOf<T> energy_sweep_for(Target, bool wind, bool field);

} // namespace bough::fast
