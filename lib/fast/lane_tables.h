// lane_tables.h: what both steps in lanes do outside of their sweeps: constants, pulls and records into rows, what a sweep is given
// of them, sums at the ports, and the memory that threads work in.
#pragma once
#include "../stages/plan.h"
#include "../stages/state.h"
#include "lane_memory.h"

namespace bough::fast {

// The constants that both steps have (body_constant), but the inertia, of which each has its own form.
template <class T> void put_body(const Plan<T>&, std::size_t body, const Slot<T>& row);

// Of the coupled step's table as it stands.
template <class T> CoupledPlaces places_of(const Plan<T>& plan, const State<T>& state, const Block& block) {
    return coupled_places(block, waits(plan.lanes.layout), scheme_of(plan.scheme).poles, state.lanes.odd);
}
// The block's part of it, for a sweep over the block.
template <class T> void place_block(const Plan<T>&, State<T>&, const Block&, CoupledRows<T>&);
// Where each row's motion stands in Lanes::now, or in Lanes::table. O(rows).
// Of a plan of the coupled step: every row's stiffness and damping times these.
template <class T> void scale_wood(Plan<T>&, T stiffness, T damping);

template <class T> std::vector<std::size_t> motion_of_rows(const Plan<T>&, const State<T>&);
template <class T> void motion_of_rows(const Plan<T>&, const State<T>&, std::vector<std::size_t>& at);

// A record of `count` for each joint of the layout; what is there stays.
template <class T> void resize_records(const Layout&, RowVector<T>& records, int count);
// Lanes::pulls: where each acts. Its force is place_tables'.
template <class T> void pack_pulls(const Plan<T>&, State<T>&);

// Fills in what SweepRows holds, with wind and pulls at the time `middle` [s].
template <class T> void place_tables(const Plan<T>&, State<T>&, double middle, SweepRows<T>&);

// The wind over the ground at the start and end of the coupled step from `time` [s].
template <class T> void place_field_change(const Plan<T>&, State<T>&, double time, CoupledRows<T>&);

// What blocks hand to the top, in the ports' order, from records of `count`. A sleeper's stands until it wakes, all others are set to zero.
template <class T> void add_ports(const Plan<T>&, State<T>&, int count);

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

} // namespace bough::fast
