// sweep_rows.h: what the sweeps of both steps in lanes (coupled_rows.h, analytic_rows.h) read and write alike, as plain memory. It has no SIMD type,
// so that every target sees the same.
//
// A row of a table is `count` quantities of 64 bytes each.
#pragma once
#include "../laws/field_shape.h"
#include "../laws/leaf_terms.h"
#include "block.h"
#include <cstddef>
#include <cstdint>

namespace bough::fast {

// Constants of a body that both steps have, in front of their own.
namespace body_constant {
enum : int {
    R_pj = 0,           // quaternion w x y z: parent's body frame from joint frame
    joint_position = 4, // [m] parent's body frame
    com = 7,            // [m]
    mass = 10,          // [kg]
    inertia_joint = 11, // [kg m^2] xx xy xz yy yz zz
    K = 17,             // [N m/rad]
    beta = 20,          // [s]
    shared_count = 21
};
}

// [reals] of a record of `count`: whole rows.
constexpr std::size_t record(int count, int lanes) {
    return std::size_t((count + lanes - 1) / lanes * lanes);
}

constexpr std::size_t no_source = ~std::size_t(0);

template <class T> struct PullOnLane {
    std::uint32_t row, lane;
    T point[3];            // [m] body frame
    T force[3], change[3]; // [N] at the step's middle, and (coupled) what it changes by over the step
    std::size_t source;    // index into Scene::pulls, or no_source: one of State::loads
    std::size_t order = 0; // of those on one row
};

// A wind that varies over the ground, as in WindField (laws/wind_field.h): its place, and its tables at one time.
template <class T> struct FieldTables {
    const T* velocity;
    const T* turn; // null: no swirl
};
template <class T> struct FieldRows {
    FieldTables<T> middle; // of the step
    FieldShape<T> shape;
    std::int32_t all_cells, all_rings; // of all clocks
    const T* shelter;                  // [1] a row of lanes for each row; null: none
    const T* clock;                    // likewise: which of the wind's clocks
};

template <class T> struct SweepRows {
    const Group* groups; // the layout's
    const std::uint32_t *base, *landing, *fork;
    const std::int32_t* fork_of_row;
    const T* constants;
    const std::uint32_t* constants_row;  // of each row, and of one beyond, which of these it reads; null: its own
    T *outward_records, *inward_records; // between chains, a record a joint
    const std::int32_t* pull_of_row;     // first in pulls, -1: none; null: no pulls at all
    const PullOnLane<T>* pulls;          // rising by row
    std::size_t pull_count;
    T h;              // [s]
    T gravity[3];     // [m/s^2]
    T wind[3];        // [m/s] where the profile is 1, at the step's middle
    const T* profile; // [1] factors over height
    std::size_t profile_entries;
    T per_metre;
    FieldRows<T> field; // for sweeps that are compiled for it
    LeafTerms<T> leaf;
    const T* facing; // [1] of clumps (Plan::facing), a row of lanes for each row; null: none has a face
};

// The parts of a scene that sweeps are compiled for.
struct SweepLoads {
    bool wind, pulls, gravity;
    bool field; // the wind varies over the ground
};

// What a sweep over a block met.
struct SweepFlags {
    std::uint64_t fast_turns = 0, half_turns = 0;
    std::uint64_t buckling = 0, bounded_lambda = 0, energy_guard = 0; // of the analytic step (StepFlags)
    bool fast = false;  // a body turned by more than the energy guard lets pass unseen (energy_guard.h)
    bool finite = true; // of theta and theta_dot
    double omega2 = 0;  // [rad^2/s^2] the fastest body's (sleep.h)

    SweepFlags& operator+=(const SweepFlags& more) {
        fast_turns += more.fast_turns;
        half_turns += more.half_turns;
        buckling += more.buckling;
        bounded_lambda += more.bounded_lambda;
        energy_guard += more.energy_guard;
        fast = fast || more.fast;
        finite = finite && more.finite;
        if (more.omega2 > omega2) omega2 = more.omega2;
        return *this;
    }
};

} // namespace bough::fast
