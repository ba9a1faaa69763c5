// attachment_lanes.h: attachments (attachment.h) where steps are made in lanes. What they add to a body's solve waits in a row of records. The sweep
// inward takes it from there as it takes what comes from a fork. It stands beside attachment_plain.h because numbers are read from rows and written
// to rows here, and from arrays of bodies there; terms and ties' solve are the same functions for both (attachment.h, attachment_ties.h).
#pragma once
#include "coupled_tables.h"

namespace bough::fast {

// Places rows for the attachments that are there. Called whenever one comes or goes. Allocates.
template <class T> void place_attached_rows(const CoupledLanesPlan<T>&, CoupledLanesState<T>&);

// Fills in AttachedBody::now at the step's start, or with `end` at its end, once the step is solved. O(bodies on paths).
template <class T> void read_attached(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, bool end);

// Puts the terms at pole p into the rows, and the rows into what sweeps are given.
template <class T> void put_attachments(const Plan<T>&, CoupledLanesState<T>&, std::complex<double> p, CoupledRows<T>&);

// Solves for attachments between bodies (attachment_ties.h) at pole p, between the sweeps inward and outward of all rows.
template <class T>
void tie_in_lanes(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&, std::complex<double> p);

// Books attachments in the energy guard: ends that are attached keep their rates, and trees are given the work done on them.
template <class T> void book_attachments(const Plan<T>&, const CoupledLanesPlan<T>&, CoupledLanesState<T>&);

} // namespace bough::fast
