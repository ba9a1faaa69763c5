// lane_tables.h: what both steps in lanes do outside of their sweeps: constants, pulls and records into rows, what a sweep is given
// of them, sums at the ports, and the memory that threads work in.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"
#include "lane_memory.h"
#include "lanes.h"

namespace bough::fast {

// The constants that both steps have (body_constant), but the inertia, of which each has its own form.
template <class T> void put_body(const Plan<T>&, std::size_t body, const Slot<T>& row);

// A record of `count` for each joint of the layout; what is there stays.
template <class T> void resize_records(const Layout&, RowVector<T>& records, int count);
// Lanes::pulls: where each acts. Its force is place_tables'.
template <class T> void pack_pulls(const Plan<T>&, const PlannedLanes<T>&, Lanes<T>&);

template <class T> SweepLoads sweep_loads(const Plan<T>&);

// Fills in what SweepRows holds, with wind and pulls at the time `middle` [s].
template <class T>
void place_tables(const Plan<T>&, const PlannedLanes<T>&, State<T>&, Lanes<T>&, double middle, SweepRows<T>&);

template <class T> FieldTables<T> tables_of(const WindField<T>& field) {
    return {field.velocity.data(), field.turn.empty() ? nullptr : field.turn.data()};
}

// What blocks hand to the top, in the ports' order, from records of `count`. A sleeper's stands until it wakes, all others are set to zero.
template <class T> void add_ports(const PlannedLanes<T>&, Lanes<T>&, int count);

// Rows of the largest block but the top.
std::size_t largest_block(const Layout&);
// Room for so many rows of one quantity, for one thread; grows where it must.
template <class T> T* room(RowVector<T>& scratch, std::size_t rows) {
    if (scratch.size() < rows) scratch.resize(rows);
    return data(scratch);
}
// About what a sweep out and in of a row, and the way in between, take one thread, in float and double alike [ns].
constexpr double row_cost = 1000;
// The same of one of the layout's blocks but the top, on average.
double block_cost(const Layout&);
// Lanes::scratch: `top` rows for the top, the first, then `each` for every thread that sweeps blocks.
template <class T> void share_scratch(const Layout&, Lanes<T>&, std::size_t top, std::size_t each);

template <class T> Rest rest_of(const Lanes<T>& lanes, std::size_t block) {
    return lanes.rest.empty() ? Rest::awake : lanes.rest[block].rest;
}

} // namespace bough::fast
