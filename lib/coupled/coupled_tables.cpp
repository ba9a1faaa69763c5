#include "coupled_tables.h"
#include "../base/caches.h"
#include <algorithm>

namespace bough::fast {

template <class T>
void place_field_change(const Plan<T>& plan, CoupledLanesState<T>& work, double time, CoupledRows<T>& rows) {
    const Wind& wind = *plan.scene.wind;
    evaluate_field(wind, time, work.wind_start);
    evaluate_field(wind, time + plan.dt, work.wind_end);
    rows.field_start = tables_of(work.wind_start);
    rows.field_end = tables_of(work.wind_end);
}

template <class T>
void place_block(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, const Block& block, CoupledRows<T>& rows) {
    const CoupledPlaces places = places_of(own, work, block);
    T* const table = data(work.lanes.table);
    constexpr std::ptrdiff_t lanes = Row<T>::lanes;
    rows.first_row = block.first_row;
    rows.now = table + places.now.first * lanes;
    rows.next = table + places.next.first * lanes;
    rows.solved_rows = table + places.solved.first * lanes;
    rows.now_stride = places.now.stride;
    rows.next_stride = places.next.stride;
    rows.solved_stride = places.solved.stride;
}

template <class T> void scale_wood(PlannedLanes<T>& planned, T stiffness, T damping) {
    RowVector<T>& constants = planned.constants;
    for (std::size_t row = 0; row + constant::count <= constants.size(); row += constant::count)
        for (std::size_t l = 0; l < Row<T>::lanes; ++l) {
            for (int k = 0; k < 3; ++k) constants[row + constant::K + k].lane[l] *= stiffness;
            constants[row + constant::beta].lane[l] *= damping;
        }
}

template <class T> void scale_changes(const CoupledLanesPlan<T>& own, CoupledLanesState<T>& work, T ratio) {
    static_assert(motion::theta_dot_change == motion::theta_change + 3);
    for (const Block& block : own.lanes.layout.blocks) {
        const Run now = places_of(own, work, block).now;
        for (std::uint32_t row = block.first_row; row < block.end_row; ++row) {
            Row<T>* const change = &work.lanes.table[std::size_t(now.at(row - block.first_row))] + motion::theta_change;
            for (int q = 0; q < 6; ++q)
                for (T& x : change[q].lane) x *= ratio;
        }
    }
}

template <class T>
void motion_of_rows(const CoupledLanesPlan<T>& own, const CoupledLanesState<T>& work, std::vector<std::size_t>& at) {
    const Layout& layout = own.lanes.layout;
    at.resize(layout.rows);
    for (const Block& block : layout.blocks) {
        const Run now = places_of(own, work, block).now;
        for (std::uint32_t row = block.first_row; row < block.end_row; ++row)
            at[row] = std::size_t(now.at(row - block.first_row));
    }
}

template <class T> void put_pad(const Slot<T>& row) {
    row.put(constant::R_pj, T(1));
    row.put(constant::K, Vector3<T>(Vector3<T>::Ones()));
}

std::size_t usable_cache() {
    static const std::size_t cache = std::clamp(last_cache(), std::size_t(32) << 20, std::size_t(64) << 20);
    return cache;
}

bool streams(const Layout& layout, std::size_t cache) {
    constexpr std::uint64_t line = 64; // [bytes] of a row of one quantity
    const std::uint64_t quantities = std::uint64_t(coupled_columns(true, 1)) + constant::count;
    return waits(layout) && layout.rows * quantities * line > cache;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void place_field_change(const Plan<T>&, CoupledLanesState<T>&, double, CoupledRows<T>&);                  \
    template void place_block(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, const Block&, CoupledRows<T>&);       \
    template void put_pad(const Slot<T>&);                                                                             \
    template void scale_wood(PlannedLanes<T>&, T, T);                                                                  \
    template void scale_changes(const CoupledLanesPlan<T>&, CoupledLanesState<T>&, T);                                 \
    template void motion_of_rows(const CoupledLanesPlan<T>&, const CoupledLanesState<T>&, std::vector<std::size_t>&);
#include "../base/instantiate.inc"

} // namespace bough::fast
