// lanes.h: what the fast path keeps beside plan and state: the layout, constants and motion in rows (coupled_rows.h).
#pragma once
#include "coupled_rows.h"
#include "layout.h"
#include "row.h"
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

// Whether rows of constants that are equal are kept once (shared_constants.h).
struct PlannedSharing {
    bool on = false;
    std::string reason;             // why not
    std::vector<std::uint32_t> row; // on: of each row, and of one beyond the last, which row of the constants it reads
};

// Of a plan; constant once it is made, but for what breaks off.
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
    PlannedSleep sleep;
};

// Whether some block's accelerations have to wait for others: then what is solved is kept for all rows.
inline bool waits(const Layout& layout) {
    for (const Block& block : layout.blocks)
        if (!block.whole && block.first_row < block.end_row) return true;
    return false;
}

// One quantity's rows, or a record's of several: that of a block's row k begins at first + k * stride, in rows of 64 bytes.
struct Run {
    std::ptrdiff_t first, stride;
    std::ptrdiff_t at(std::uint32_t k) const { return first + std::ptrdiff_t(k) * stride; }
};
// Where in the coupled step's table stand a block's motion at the step's start, at its end, and what is solved. Each is one stretch of
// memory, as a core likes to read it. Outward, a row's solution is read for the last time where its motion's end is found, and takes
// more room than that: the one runs along where the others before it have stood, with one solve a step 66 quantities a body, not
// 78, and the lines that are written are in the core's cache already. From step to step the motions change places, from the front of the
// block's stretch to its back, and so does the direction in which the rows stand.
struct CoupledPlaces {
    Run now, next, solved;
};
// Quantities a row in all. poles: solves a step; waits: as below.
constexpr int coupled_columns(bool waits, int poles) {
    if (!waits) return 2 * int(motion::count); // nothing is solved beyond a core's cache
    return int(solved::count) + (poles > 1 ? 2 : 1) * int(motion::count);
}
inline CoupledPlaces coupled_places(const Block& block, bool waits, int poles, bool odd) {
    constexpr std::ptrdiff_t m = motion::count, s = solved::count;
    const std::ptrdiff_t count = coupled_columns(waits, poles), rows = block.end_row - block.first_row;
    const std::ptrdiff_t front = count * block.first_row, back = front + count * rows;
    if (waits && poles == 1)
        return odd ? CoupledPlaces{{back - m, -m}, {front, m}, {front, s}}
                   : CoupledPlaces{{front, m}, {back - m, -m}, {back - s, -s}};
    const Run one{front, m}, other{front + m * rows, m}; // solved anew while the end is being summed up
    return {odd ? other : one, odd ? one : other, {front + 2 * m * rows, s}};
}

// [rows] that the three records of a joint take.
template <class T> constexpr int records_of_joint() {
    constexpr int L = Row<T>::lanes;
    return int((record(outward::count, L) + record(inward::count, L) + record(accelerated::count, L)) / L);
}

// Of a state.
template <class T> struct Lanes {
    RowVector<T> now;                          // of the analytic step: motion
    RowVector<T> table;                        // of the coupled step: CoupledColumns
    bool odd = false;                          // which of them
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
    bool presented = true;       // the state's arrays in document order hold what `now` holds
    bool finite = true;          // no theta or theta_dot has become non-finite

    // Of rows, but what threads work in, and the energy guard's.
    std::size_t bytes() const {
        std::size_t rows = 0;
        for (const auto* some : {&now, &table, &outward, &inward, &accelerated}) rows += some->capacity();
        return rows * sizeof(Row<T>);
    }
};

} // namespace bough::fast
