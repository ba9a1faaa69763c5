#include "coupled_targets.h"
#include "../lanes/target_code.h"

namespace bough::fast {

BOUGH_IN_TARGETS(template <class T> CoupledSweeps<T> coupled_sweeps(bool wind, bool gravity, bool field);)
BOUGH_IN_TARGETS(template <class T> EnergySweepOf<T> energy_sweep(bool wind, bool field);)

template <class T> CoupledSweeps<T> coupled_sweeps_for(Target target, bool wind, bool gravity, bool field) {
    return BOUGH_OF_TARGET(target, coupled_sweeps<T>(wind, gravity, field));
}

template <class T> EnergySweepOf<T> energy_sweep_for(Target target, bool wind, bool field) {
    return BOUGH_OF_TARGET(target, energy_sweep<T>(wind, field));
}

template CoupledSweeps<float> coupled_sweeps_for(Target, bool, bool, bool);
template CoupledSweeps<double> coupled_sweeps_for(Target, bool, bool, bool);
template EnergySweepOf<float> energy_sweep_for(Target, bool, bool);
template EnergySweepOf<double> energy_sweep_for(Target, bool, bool);

} // namespace bough::fast
