// coupled_alone.cpp: the page runs the coupled method alone: the analytic one's sweeps, a sixth of the whole module, are left out.
#include "lib/analytic/analytic_sweeps.h"
#include <stdexcept>

namespace bough::fast::baseline {

template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads) {
    throw std::logic_error("the analytic method is no part of the page");
}
template AnalyticSweeps<float> analytic_sweeps(AnalyticLoads);
template AnalyticSweeps<double> analytic_sweeps(AnalyticLoads);

} // namespace bough::fast::baseline
