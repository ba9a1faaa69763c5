#include "clear_lanes.h"
#include <cassert>

namespace bough::fast {

template <class T>
void clear_lanes(PlannedLanes<T>& planned, RowVector<T>& rows, const std::vector<std::size_t>& motion_at, int constants,
                 int motions, void (*pad)(const Slot<T>&), const std::vector<std::size_t>& bodies) {
    assert(!planned.sharing.on); // never with /fracture
    constexpr std::size_t lanes = Row<T>::lanes;
    for (const std::size_t body : bodies) {
        const std::size_t slot = planned.layout.slot[body];
        const Slot<T> row(planned.constants, constants, slot);
        for (int k = 0; k < constants; ++k) row.put(k, T(0));
        pad(row);
        for (int k = 0; k < motions; ++k) rows[motion_at[slot / lanes] + std::size_t(k)].lane[slot % lanes] = 0;
    }
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void clear_lanes(PlannedLanes<T>&, RowVector<T>&, const std::vector<std::size_t>&, int, int,              \
                              void (*)(const Slot<T>&), const std::vector<std::size_t>&);
#include "../base/instantiate.inc"

} // namespace bough::fast
