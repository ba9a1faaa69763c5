// coupled_rows.h: what the coupled step's sweeps over lanes (coupled_sweeps.h) read and write, as plain memory: which
// quantity stands where in a row, and all that a sweep is given. No SIMD type here, so that every target sees the same.
//
// A row of a table is `count` quantities of 64 bytes each. Quantities as in coupled_body.h, where the frame of each is said.
#pragma once
#include "block.h"
#include <cstddef>
#include <cstdint>

namespace bough::fast {

// What changes from step to step and is carried.
namespace motion {
enum : int { theta = 0, theta_dot = 3, theta_change = 6, theta_dot_change = 9, count = 12 };
}

// Constants of a body.
namespace constant {
enum : int {
    R_pj = 0,            // quaternion w x y z: parent's body frame from joint frame
    joint_position = 4,  // [m]
    com = 7,             // [m]
    mass = 10,           // [kg]
    inertia_joint = 11,  // [kg m^2] xx xy xz yy yz zz
    K = 17,              // [N m/rad]
    beta = 20,           // [s]
    carried_moment = 21, // [kg m]
    drag_area = 24,      // [kg/m]
    count = 25
};
}

// From the first sweep outward to the sweep inward, in a thread's own memory.
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
    rates = 45,
    r = 54,
    count = 57
};
}

// From the sweep inward to the second one outward. (E: (A + Z)^-1.)
namespace solved {
enum : int { Eu = 0, EA = 6, EB = 24, rates = 42, r = 51, count = 54 };
}

// Between chains, a record a joint.
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
    count = 34
};
}
namespace inward {
enum : int { A = 0, B = 12, M = 30, N = 42, F = 48, count = 54 };
}
namespace accelerated {
enum : int { alpha = 0, a = 6, count = 12 };
}

// [reals] of a record of `count`: whole rows.
constexpr std::size_t record(int count, int lanes) {
    return std::size_t((count + lanes - 1) / lanes * lanes);
}

template <class T> struct PullOnLane {
    std::uint32_t row, lane;
    T point[3];            // [m] body frame
    T force[3], change[3]; // [N] at the step's middle, and what it changes by over the step
};

template <class T> struct CoupledRows {
    const Group* groups; // the layout's
    const std::uint32_t *base, *landing, *fork;
    const std::int32_t* fork_of_row;

    const T* constants;
    const T* now;   // motion at the step's start
    T* next;        // and at its end
    T* solved_rows; // from row solved_first on
    std::uint32_t solved_first;
    T *outward_records, *inward_records, *accelerated_records;
    const std::int32_t* pull_of_row; // first in pulls, -1: none; null: no pulls at all
    const PullOnLane<T>* pulls;      // rising by row
    // Of each lane's chain (as base): a body of it turned fast, to be looked at by the energy guard.
    std::uint8_t* watched;
    std::size_t pull_count;

    bool adds, ends;          // a scheme's poles, a solve each: adds to the changes of those before; its last
    bool stream;              // solved_rows are more than the caches hold
    T h;                      // [s]
    T s1[2], s2[2], slope[2]; // 1/s, 1/s^2, 1/p - 1/2
    // x's weights in the changes of theta_dot and theta, and theta_dot's in that of theta.
    T of_rate[2], of_angle[2], eta;
    T gravity[3];              // [m/s^2]
    T wind[3], wind_change[3]; // [m/s] where the profile is 1, at the step's middle and over it
    const T* profile;          // [1] factors over height
    std::size_t profile_entries;
    T per_metre;
    // theta past half a turn, of one body: the shorter way round (coupled/half_turn.h). False where it was not.
    bool (*shorten)(T* theta, T* theta_dot, T* theta_change, T* theta_dot_change, T h);
};

// What a sweep over a block met with.
struct SweepFlags {
    std::uint64_t fast_turns = 0, half_turns = 0;
    std::uint64_t buckling = 0, bounded_lambda = 0, energy_guard = 0; // of the analytic step (StepFlags)
    bool fast = false;  // a body turned by more than the energy guard lets pass unseen (energy_guard.h)
    bool finite = true; // of theta and theta_dot
    double omega2 = 0;  // [rad^2/s^2] the fastest body's (sleep.h)
};

} // namespace bough::fast
