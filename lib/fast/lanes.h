// lanes.h: what the fast path keeps beside plan and state: the layout, constants and motion in rows (coupled_rows.h).
#pragma once
#include "coupled_rows.h"
#include "layout.h"
#include "row.h"
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

// In the plan. Constant after make_plan.
template <class T> struct PlannedLanes {
    bool on = false;
    std::string reason; // why, or why not
    Layout layout;
    RowVector<T> constants;
    std::vector<std::int32_t> pull_of_row; // empty without pulls
    std::vector<std::size_t> pull;         // Plan::pulls in the order of rows
    std::vector<T> profile;                // [1] the wind's, over height
    T per_metre = 0;
    PlannedSleep sleep;
};

// Whether some block's accelerations have to wait for others: then what is solved is kept for all rows.
inline bool waits(const Layout& layout) {
    for (const Block& block : layout.blocks)
        if (!block.whole && block.first_row < block.end_row) return true;
    return false;
}

// Where in a row of the coupled step's table stand the motion at the step's start, at its end, and what is solved [quantities].
// A row's solution is read for the last time where its motion's end is found, so that the one stands where the other stood: with one
// solve a step 66 quantities a body, not 78, and the lines that the end is written to are in the core's cache already. From step to step the
// motions change places.
struct CoupledColumns {
    int now, next, solved, count;
};
inline CoupledColumns coupled_columns(bool waits, int poles, bool odd) {
    constexpr int m = motion::count, all = m + solved::count;
    if (waits && poles == 1) return odd ? CoupledColumns{all - m, 0, 0, all} : CoupledColumns{0, all - m, m, all};
    // Nothing is solved beyond a core's cache; or it is solved anew while the end is being summed up.
    return {odd ? m : 0, odd ? 0 : m, 2 * m, 2 * m + (waits ? int(solved::count) : 0)};
}

// [rows] that the three records of a joint take.
template <class T> constexpr int records_of_joint() {
    constexpr int L = Row<T>::lanes;
    return int((record(outward::count, L) + record(inward::count, L) + record(accelerated::count, L)) / L);
}

// In the state.
template <class T> struct Lanes {
    RowVector<T> now;                          // of the analytic step: motion
    RowVector<T> table;                        // of the coupled step: CoupledColumns
    bool odd = false;                          // which of them
    RowVector<T> outward, inward, accelerated; // a record a joint
    std::vector<RowVector<T>> scratch;         // one a thread, and one more for the top
    std::vector<PullOnLane<T>> pulls;
    std::vector<SweepFlags> flags;     // one a block
    std::vector<std::uint8_t> watched; // CoupledRows
    RowVector<T> energy_records, energy_sums, energy_fast,
        energy_ground;           // EnergyRows; empty until something turns fast
    std::vector<BlockRest> rest; // one a block; empty where nothing may sleep
    double carried_turn = 0;     // [rad] of what sleepers stand on, at most, since the first fell asleep
    bool presented = true;       // the state's arrays in document order hold what `now` holds
    bool finite = true;          // no theta or theta_dot has become non-finite
};

} // namespace bough::fast
