// energy_sweep.h: the energy guard's weighing (coupled/energy_guard.h) in one sweep over a block's rows: how a step has changed each chain's
// energies, from the motion at its start and at its end, which are both still there.
//
// It is written a second time because lanes keep no poses: the plain guard reads those of the start and the end from arrays, once before the step is
// taken and once after. tests/lib/coupled/energy_guard.cpp holds the two together.
// Three poses go outward side by side: the start's and the end's, as seen from the ground, and with wind that of y*, in which the step took the air's
// force. Sums go over a lane's chain, in its order. The caller adds them up by trees, group by group. The cost is up to that of the outward
// sweep, and only arises in steps in which something turned fast.
#pragma once
#include "coupled_rows.h"

namespace bough::fast {

namespace energy {
enum : int {   // a record a joint
    start = 0, // R, x, omega, v
    end = 18,
    fast_omega = 36,
    fast_v = 39,
    R = 42,
    y = 51,
    omega = 52,
    v = 55,
    turn = 58,
    x = 61, // at y*, where the wind varies over the ground
    z = 62,
    count = 63
};
enum : int { kinetic = 0, gained = 1, slow = 2, mixed = 3, fast = 4, sums = 5 }; // of EnergyAccount [J]
} // namespace energy

template <class T> struct EnergyRows {
    T* records;
    T* sums; // of a group: energy::sums rows of lanes, at first_base * energy::sums
    T* fast; // a row of lanes for each row: 1 where the body turns fast; of ends of branches what is kept of its rate
    // Where the ground is moved, for each group 6 rows of lanes, at first_base * 6: how far it goes in the step [m], and its acceleration [m/s^2].
    // null: all of it rests.
    const T* ground;
};

template <class T> using EnergySweepOf = void (*)(const CoupledRows<T>&, const EnergyRows<T>&, const Block&);

} // namespace bough::fast
