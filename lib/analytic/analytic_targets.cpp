#include "analytic_targets.h"
#include "../lanes/target_code.h"

namespace bough::fast {

BOUGH_IN_TARGETS(template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads);)

template <class T> AnalyticSweeps<T> analytic_sweeps_for(Target target, AnalyticLoads loads) {
    return BOUGH_OF_TARGET(target, analytic_sweeps<T>(loads));
}

template AnalyticSweeps<float> analytic_sweeps_for(Target, AnalyticLoads);
template AnalyticSweeps<double> analytic_sweeps_for(Target, AnalyticLoads);

} // namespace bough::fast
