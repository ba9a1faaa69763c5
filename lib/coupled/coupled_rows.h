// coupled_rows.h: what the coupled step's sweeps over lanes (coupled_sweeps.h) read and write: the place of each quantity in a row, and all that a
// sweep is given (sweep_rows.h). Quantities are those of coupled_body.h, which names the frame of each.
#pragma once
#include "../lanes/sweep_rows.h"
#include "../model/air_constants.h"

namespace bough::fast {

// What changes from step to step and is carried.
namespace motion {
enum : int { theta = 0, theta_dot = 3, theta_change = 6, theta_dot_change = 9, count = 12 };
}

// Constants of a body.
namespace constant {
using namespace body_constant;
enum : int {
    carried_moment = shared_count, // [kg m]
    drag_area = 24,                // [kg/m]
    carried_drag = 25,             // [kg]
    count = 28
};
} // namespace constant

// Goes from the first sweep outward to the sweep inward, in a thread's own memory.
namespace loaded {
enum : int {
    c = 0,       // [m]
    J = 3,       // symmetric
    H = 9,       // symmetric
    D = 15,      // symmetric
    N = 21,      // complex: with the slopes and H's part
    F = 27,      // complex
    torque = 33, // complex: the spring's and damper's
    K = 39,      // symmetric: T^T K T in world axes
    r = 45,
    count = 48
};
}

// Goes from the first sweep outward (rates, r) and the sweep inward to the second sweep outward. (E: (A + Z)^-1.)
namespace solved {
enum : int { Eu = 0, EA = 6, EB = 24, rates = 42, r = 51, count = 54 };
}

// Goes between chains, a record a joint.
namespace outward {
enum : int {
    R = 0,
    y = 9,
    omega = 10,
    v = 13,
    ahead_omega = 16,
    ahead_v = 19,
    own = 22,
    turn = 25,
    alpha = 28,
    a = 31,
    x = 34, // where the wind varies over the ground,
    z = 35, // whole rows having room for them
    count = 36
};
}
namespace inward {
enum : int { A = 0, B = 12, M = 30, N = 42, F = 48, count = 54 };
}
namespace accelerated {
enum : int { alpha = 0, a = 6, count = 12 };
}

template <class T> struct CoupledRows : SweepRows<T> {
    // A block's rows from first_row on, each with its stride from row to row [quantities] (CoupledPlaces).
    std::uint32_t first_row;
    const T* now; // motion at the step's start
    T* next;      // and at its end; a row's may stand where its own `solved` stands, or one before it stood
    T* solved_rows;
    std::ptrdiff_t now_stride, next_stride, solved_stride;
    T* accelerated_records;
    // For each lane's chain (as base): set if a body of it turned fast, for the energy guard to look at; 1 of wood, 2 of what hangs at its ends.
    std::uint8_t* watched;

    const std::int32_t*
        attached_of_row; // of each row, which of `attached` is added to it, -1: none; null: no attachments
    T* attached;         // records inward, a row each quantity
    T* inverses; // of the rows that `attached` has: E of resolvent.h, complex symmetric, for attachments between bodies; else null

    Folds<T> folds;           // of leaves, where there is foliage: how the drag of what bodies carry is taken
    bool adds, ends;          // a scheme's poles, a solve each: adds to the changes of those before; its last
    bool stream;              // solved_rows are more than the caches hold, and go past them
    T s1[2], s2[2], slope[2]; // 1/s, 1/s^2, 1/p - 1/2
    // The weights of x in the changes of theta_dot and theta, and that of theta_dot in the change of theta.
    T of_rate[2], of_angle[2], eta;
    T wind_change[3]; // [m/s] of `wind` over the step
    FieldTables<T> field_start, field_end;
    // Takes one body's theta past half a turn the shorter way round (coupled/half_turn.h). Returns false where it was not past.
    bool (*shorten)(T* theta, T* theta_dot, T* theta_change, T* theta_dot_change, T h);
};

} // namespace bough::fast
