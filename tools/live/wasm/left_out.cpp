// left_out.cpp: what the library does and the page never asks for. Linked, it would be a sixth of the whole module. Each says that it is not here.
#include "lib/analytic/analytic_lanes_stepper.h"
#include "lib/coupled/coupled_lanes_stepper.h"
#include "lib/coupled/coupled_stepper.h"
#include "lib/simulation/explanation.h"
#include "lib/simulation/fingerprint.h"
#include "lib/simulation/saved.h"
#include <stdexcept>

namespace bough {
namespace {

[[noreturn]] void no_part(const char* what) {
    throw std::logic_error(std::string(what) + " is no part of the page");
}

} // namespace

// The page runs the coupled method alone.
template <class T> std::unique_ptr<Stepper<T>> fast::analytic_stepper(const Scene&, std::optional<Target>, double) {
    no_part("the analytic method");
}

// A plan's account of itself is the command line's to print.
template <class T> std::string explanation(const Plan<T>&, const std::vector<std::string>&) {
    no_part("a plan's account");
}

template <class T> void CoupledStepper<T>::explain(const Plan<T>&, PlanAccount&) const {
    no_part("a plan's account");
}
template <class T> void fast::CoupledLanesStepper<T>::explain(const Plan<T>&, PlanAccount&) const {
    no_part("a plan's account");
}

// The address and the scene hold what is shared; a run between two steps is not.
template <class T> void save_run(Run<T>&, std::int64_t, SavedState&) {
    no_part("a saved state");
}
template <class T> void restore_run(const SavedState&, std::int64_t, Run<T>&) {
    no_part("a saved state");
}
std::optional<Defect> check(const SavedState&) {
    no_part("a saved state");
}
double saved_time(const SavedState&, std::int64_t, double) {
    no_part("a saved state");
}
std::uint64_t fingerprint(const Tree&, const Scene&) {
    return 0; // of each run: there is no saved state that has to know its own
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template std::unique_ptr<Stepper<T>> fast::analytic_stepper(const Scene&, std::optional<Target>, double);          \
    template std::string explanation(const Plan<T>&, const std::vector<std::string>&);                                 \
    template void CoupledStepper<T>::explain(const Plan<T>&, PlanAccount&) const;                                      \
    template void fast::CoupledLanesStepper<T>::explain(const Plan<T>&, PlanAccount&) const;                           \
    template void save_run(Run<T>&, std::int64_t, SavedState&);                                                        \
    template void restore_run(const SavedState&, std::int64_t, Run<T>&);
#include "lib/base/instantiate.inc"

} // namespace bough
