// attachment_lanes.h: attachments (attachment.h) where steps are made in lanes: what they add to a body's solve waits in a row of records, from which
// the sweep inward takes it as it takes what comes of a fork.
#pragma once
#include "coupled_tables.h"

namespace bough::fast {

// Of the attachments that are there: allocates. To be called whenever one comes or goes.
template <class T> void place_attached_rows(const CoupledLanesPlan<T>&, CoupledLanesState<T>&);

// AttachedBody::now at the step's start, or with `end` once it is solved. O(bodies on paths).
template <class T> void read_attached(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, bool end);

// The terms at pole p into the rows, and these into what sweeps are given.
template <class T> void put_attachments(const Plan<T>&, CoupledLanesState<T>&, std::complex<double> p, CoupledRows<T>&);

// Attachments between bodies (attachment_ties.h) at pole p, between the sweeps inward and outward of all rows.
template <class T>
void tie_in_lanes(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&, std::complex<double> p);

// In the energy guard: ends that are attached keep their rates, and trees the work done on them.
template <class T> void book_attachments(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&);

} // namespace bough::fast
