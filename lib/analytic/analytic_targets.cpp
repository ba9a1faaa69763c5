#include "analytic_targets.h"
#include "../lanes/target_code.h"

namespace bough::fast {

BOUGH_IN_TARGETS(template <class T> AnalyticSweeps<T> analytic_sweeps(SweepLoads);)

template <class T> AnalyticSweeps<T> analytic_sweeps_for(Target target, SweepLoads loads) {
    return BOUGH_OF_TARGET(target, analytic_sweeps<T>(loads));
}

template AnalyticSweeps<float> analytic_sweeps_for(Target, SweepLoads);
template AnalyticSweeps<double> analytic_sweeps_for(Target, SweepLoads);

} // namespace bough::fast
