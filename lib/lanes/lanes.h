// lanes.h: what a step in lanes keeps beside plan and state: the layout, constants and motion in rows (sweep_rows.h).
#pragma once
#include "layout.h"
#include "row.h"
#include "sweep_rows.h"
#include "target.h"
#include <cstddef>
#include <string>
#include <vector>

namespace bough::fast {

// Which blocks may sleep, and when (sleep.h).
struct PlannedSleep {
    bool on = false;
    std::string reason = "not asked for"; // why not
    double rate = 0;                      // [rad/s]
    std::uint32_t steps = 0;              // below it before a block sleeps
    std::vector<std::uint32_t> bodies;    // of each block
    std::vector<std::uint32_t> block_of_port, block_of_pull;
};
enum class Rest : std::uint8_t { awake, settling, asleep };
struct BlockRest {
    std::uint32_t settled = 0; // steps in a row below the rate, at most the plan's
    Rest rest = Rest::awake;
};

// Whether equal rows of constants are kept only once (shared_constants.h).
struct PlannedSharing {
    bool on = false;
    std::string reason;             // why not
    std::vector<std::uint32_t> row; // on: of each row, and of one beyond the last, which row of the constants it reads
};

// A plan's part. It is constant once it is made, except for what breaks off.
template <class T> struct PlannedLanes {
    Target target = Target::baseline; // what the code is compiled for
    Layout layout;
    RowVector<T> constants; // a row each row, or each different one
    PlannedSharing sharing;
    std::vector<std::int32_t> pull_of_row; // empty without pulls
    std::vector<std::size_t> pull;         // Plan::pulls in the order of rows
    std::vector<T> profile;                // [1] the wind's, over height
    T per_metre = 0;
    RowVector<T> shelter; // of bodies, a row each row; empty without
    RowVector<T> clock;   // likewise
    RowVector<T> facing;  // likewise
    PlannedSleep sleep;
};

// A state's part.
template <class T> struct Lanes {
    RowVector<T> now;                          // of the analytic step: motion
    RowVector<T> table;                        // of the coupled step: motions and solutions (coupled_places.h)
    bool odd = false;                          // the coupled step: an odd number of steps was taken
    RowVector<T> outward, inward, accelerated; // a record a joint
    std::vector<RowVector<T>> scratch;         // one a thread, and one more for the top
    std::vector<PullOnLane<T>> pulls;
    std::vector<std::int32_t> pull_of_row; // the plan's, and of State::loads, where there may be some
    std::vector<SweepFlags> flags;         // one a block
    std::vector<std::uint8_t> watched;     // CoupledRows
    std::vector<std::uint8_t> weighed;     // blocks that the energy guard looks at in this step
    std::vector<std::size_t> motion_at;    // motion_of_rows, once presented
    RowVector<T> energy_records, energy_sums, energy_fast,
        energy_ground;           // EnergyRows; empty until something turns fast
    std::vector<BlockRest> rest; // one a block; empty where nothing may sleep
    double carried_turn = 0;     // [rad] of what sleepers stand on, at most, since the first fell asleep
    bool presented = true;       // the state's arrays in document order hold what `now` or `table` holds
    bool finite = true;          // no theta or theta_dot has become non-finite

    // Counts rows, without what threads work in and without the energy guard's.
    std::size_t bytes() const {
        std::size_t rows = 0;
        for (const auto* some : {&now, &table, &outward, &inward, &accelerated}) rows += some->capacity();
        return rows * sizeof(Row<T>);
    }
};

} // namespace bough::fast
