// attachment_plain.h: attachments between bodies (attachment_ties.h) in the plain step's solve (resolvent.h); in lanes: attachment_lanes.h.
//
// A source of its own: beside it GCC 12 left products of that solve uninlined, 8 % (float) and 15 % (double) more instructions for every tree.
#pragma once
#include "coupled_state.h"

namespace bough {

// At pole p, between the sweeps inward and outward: takes what the ties carry off u of the bodies of their paths. `body`: of all, S their field.
template <class T, class S>
void tie_bodies(const Plan<T>&, CoupledWork<T>&, std::vector<ResolventBody<S>>& body, std::complex<double> p);

} // namespace bough
