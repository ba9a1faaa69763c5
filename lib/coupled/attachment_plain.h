// attachment_plain.h: attachments between bodies (attachment_ties.h) in the plain step's solve (resolvent.h); in lanes: attachment_lanes.h.
//
// This has a source file of its own: beside the plain solve, GCC 12 left products of that solve uninlined, which cost 8 % (float) and 15 % (double)
// more instructions for every tree.
#pragma once
#include "coupled_state.h"

namespace bough {

// Runs at pole p between the sweeps inward and outward. Takes what the ties carry off u of the bodies of their paths. `body`: all bodies, S their
// field.
template <class T, class S>
void tie_bodies(const Plan<T>&, CoupledWork<T>&, std::vector<ResolventBody<S>>& body, std::complex<double> p);

} // namespace bough
