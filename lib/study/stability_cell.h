// stability_cell.h: what a cell of the grid of extremes is found to be; stability.h says by what it is judged.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>

namespace bough {

struct StabilityCell {
    std::string group;             // axis of the grid, e.g. "stiffness"
    std::string name;              // the case on that axis, e.g. "K x 1e-3"
    std::string solver, precision; // "analytic" ..., "float" or "double"
    bool finite = false, bounded = false;
    bool promised = false; // bough promises that this cell holds: finite, bounded, and where compared it moves rightly
    bool compared = false, moves = true; // held against the truth; moves as that does
    bool outside = false;                // outside the method's assumption; note says which
    double energy_drift = NAN; // [1] energy above initial + work of the external forces, of the largest so far
    double ringing = NAN;      // [1/frame] sign changes of the joints' velocities
    double max_angle = NAN;    // [rad] largest joint angle
    double rms_growth = NAN;   // [1] RMS of the last quarter over that of the third
    double lean_error = NAN,
           spread_error = NAN; // [1] of the trunk's top, where compared: mean lean, standard deviation
    std::int64_t still = 0;    // frames in which nothing moves, where compared
    std::uint64_t guards = 0;  // times that a guard acted
    std::int64_t frames = 0;   // run; 0 if the cell was not
    std::string note;          // what failed, or why it is outside
};

} // namespace bough
