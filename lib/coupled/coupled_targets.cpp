#include "coupled_targets.h"
#include "../lanes/target_code.h"

namespace bough::fast {

BOUGH_IN_TARGETS(template <class T> CoupledSweeps<T> coupled_sweeps(SweepLoads);)
BOUGH_IN_TARGETS(template <class T> EnergySweepOf<T> energy_sweep(SweepLoads);)

template <class T> CoupledSweeps<T> coupled_sweeps_for(Target target, SweepLoads loads) {
    return BOUGH_OF_TARGET(target, coupled_sweeps<T>(loads));
}

template <class T> EnergySweepOf<T> energy_sweep_for(Target target, SweepLoads loads) {
    return BOUGH_OF_TARGET(target, energy_sweep<T>(loads));
}

template CoupledSweeps<float> coupled_sweeps_for(Target, SweepLoads);
template CoupledSweeps<double> coupled_sweeps_for(Target, SweepLoads);
template EnergySweepOf<float> energy_sweep_for(Target, SweepLoads);
template EnergySweepOf<double> energy_sweep_for(Target, SweepLoads);

} // namespace bough::fast
