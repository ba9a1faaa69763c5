// lane_tables.h: what both steps in lanes do outside of their sweeps: they put constants, pulls and records into rows, give these to a sweep, sum at
// the ports, and provide the memory that threads work in.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"
#include "lane_memory.h"
#include "lanes.h"

namespace bough::fast {

// Puts the constants that both steps have (body_constant), except the inertia, of which each has its own form.
template <class T> void put_body(const Plan<T>&, std::size_t body, const Slot<T>& row);

// Makes a record of `count` for each joint of the layout. What is there stays.
template <class T> void resize_records(const Layout&, RowVector<T>& records, int count);
// Fills in Lanes::pulls with where each pull acts. place_tables fills in its force.
template <class T> void pack_pulls(const Plan<T>&, const PlannedLanes<T>&, Lanes<T>&);

template <class T> SweepLoads sweep_loads(const Plan<T>&);

// Fills in what SweepRows holds, with wind and pulls at the time `middle` [s].
template <class T>
void place_tables(const Plan<T>&, const PlannedLanes<T>&, State<T>&, Lanes<T>&, double middle, SweepRows<T>&);

template <class T> FieldTables<T> tables_of(const WindField<T>& field) {
    return {field.velocity.data(), field.turn.empty() ? nullptr : field.turn.data()};
}

// Sums what blocks hand to the top, in the ports' order, from records of `count`. A sleeper's record stands until it wakes; all others are set to
// zero.
template <class T> void add_ports(const PlannedLanes<T>&, Lanes<T>&, int count);

// Returns the rows of the largest block except the top.
std::size_t largest_block(const Layout&);
// Makes room for so many rows of one quantity, for one thread. It grows where it must.
template <class T> T* room(RowVector<T>& scratch, std::size_t rows) {
    if (scratch.size() < rows) scratch.resize(rows);
    return data(scratch);
}
// [ns] About how long a sweep out and in of a row, and the way in between, takes one thread, in float and double alike.
constexpr double row_cost = 1000;
// [ns] The same for one of the layout's blocks except the top, on average.
double block_cost(const Layout&);
// Makes Lanes::scratch: first `top` rows for the top, then `each` rows for every thread that sweeps blocks.
template <class T> void share_scratch(const Layout&, Lanes<T>&, std::size_t top, std::size_t each);

template <class T> Rest rest_of(const Lanes<T>& lanes, std::size_t block) {
    return lanes.rest.empty() ? Rest::awake : lanes.rest[block].rest;
}

} // namespace bough::fast
