// coupled_alone.cpp: the page runs the coupled method alone: the analytic one's sweeps, a sixth of the whole module, and its attachments are left out.
#include "lib/analytic/analytic_sweeps.h"
#include "lib/analytic/held_points.h"
#include <stdexcept>

namespace bough {
namespace {

[[noreturn]] void no_part() {
    throw std::logic_error("the analytic method is no part of the page");
}

} // namespace

template <class T> void begin_held(const Plan<T>&, AnalyticWork<T>&) {
    no_part();
}
template <class T> void release_held(const Plan<T>&, AnalyticWork<T>&, const std::vector<std::size_t>&) {
    // There are none.
}
template <class T> void hold_points(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, AnalyticWork<T>&, double) {
    no_part();
}
template <class T> void slow_held(const Plan<T>&, State<T>&, AnalyticWork<T>&) {
    no_part();
}
#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void begin_held(const Plan<T>&, AnalyticWork<T>&);                                                        \
    template void release_held(const Plan<T>&, AnalyticWork<T>&, const std::vector<std::size_t>&);                     \
    template void hold_points(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, AnalyticWork<T>&, double);      \
    template void slow_held(const Plan<T>&, State<T>&, AnalyticWork<T>&);
BOUGH_INSTANTIATE(float)
BOUGH_INSTANTIATE(double)
#undef BOUGH_INSTANTIATE

} // namespace bough

namespace bough::fast::baseline {

template <class T> AnalyticSweeps<T> analytic_sweeps(AnalyticLoads) {
    no_part();
}
template AnalyticSweeps<float> analytic_sweeps(AnalyticLoads);
template AnalyticSweeps<double> analytic_sweeps(AnalyticLoads);

} // namespace bough::fast::baseline
