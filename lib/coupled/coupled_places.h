// coupled_places.h: where the coupled step's motions and solutions stand in its one table (Lanes::table).
#pragma once
#include "../lanes/layout.h"
#include "../lanes/row.h"
#include "coupled_rows.h"
#include <cstddef>

namespace bough::fast {

// The rows of one quantity, or of a record of several. Those of a block's row k begin at first + k * stride, in rows of 64 bytes.
struct Run {
    std::ptrdiff_t first, stride;
    std::ptrdiff_t at(std::uint32_t k) const { return first + std::ptrdiff_t(k) * stride; }
};
// Where a block's motion at the step's start, its motion at the end, and what is solved stand in the coupled step's table. Each is one stretch of
// memory, as a core likes to read it. Outward, a row's solution is read for the last time where its motion's end is found, and takes more room than
// that. So the ends run along where solutions before them have stood: with one solve a step this takes 66 quantities a body, not 78, and the lines
// that are written are in the core's cache already. From step to step the motions change places, from the front of the block's stretch to its back,
// and the rows change direction.
struct CoupledPlaces {
    Run now, next, solved;
};
// Returns the number of quantities a row. poles: solves a step. waits: as in layout.h; some block's accelerations wait for others', so what is solved
// is kept for all rows.
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

// [rows] Returns how many the three records of a joint take.
template <class T> constexpr int records_of_joint() {
    constexpr int L = Row<T>::lanes;
    return int((record(outward::count, L) + record(inward::count, L) + record(accelerated::count, L)) / L);
}

} // namespace bough::fast
