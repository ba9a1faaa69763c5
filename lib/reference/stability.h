// stability.h: what `treeprofile stability` finds: a grid of extreme cases, each cell a bounded run of one case with one
// solver and precision. "Bounded" is the definition of formats/README.md; positions being finite proves nothing.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

struct StabilityCell {
    std::string group;             // axis of the grid, e.g. "stiffness"
    std::string name;              // the case on that axis, e.g. "K x 1e-3"
    std::string solver, precision; // "analytic" ..., "float" or "double"
    bool finite = false, bounded = false;
    bool promised = false;     // bough promises that this cell holds: finite and bounded
    bool outside = false;      // outside the method's assumption; note says which
    double energy_drift = NAN; // [1] energy above initial + work of the external forces, of the largest so far
    double ringing = NAN;      // [1/frame] sign changes of the joints' velocities
    double max_angle = NAN;    // [rad] largest joint angle
    double rms_growth = NAN;   // [1] RMS of the last quarter over that of the third
    std::uint64_t guards = 0;  // times that a guard acted
    std::int64_t frames = 0;   // run; 0 if the cell was not
    std::string note;          // what failed, or why it is outside
};

struct StabilityReport {
    std::vector<StabilityCell> cells;
    std::int64_t bodies = 0;
    double fps = 30;
};

} // namespace bough
