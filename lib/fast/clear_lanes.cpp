#include "clear_lanes.h"
#include "../analytic/analytic_stepper.h"
#include "analytic_rows.h"
#include <cassert>

namespace bough::fast {

template <class T> void put_pad(const Slot<T>& row) {
    row.put(constant::R_pj, T(1));
    row.put(constant::K, Vector3<T>(Vector3<T>::Ones()));
}

template <class T> void put_analytic_pad(const Slot<T>& row) {
    row.put(analytic::constant::R_pj, T(1));
    row.put(analytic::constant::inertia_joint, Matrix3<T>(pad_inertia<T> * Matrix3<T>::Identity()));
    row.put(analytic::constant::K, Vector3<T>(Vector3<T>::Constant(pad_inertia<T> * pad_rate2<T>)));
    row.put(analytic::constant::bend, T(1));
    row.put(analytic::constant::twist, T(1));
}

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
    template void put_pad(const Slot<T>&);                                                                             \
    template void put_analytic_pad(const Slot<T>&);                                                                    \
    template void clear_lanes(PlannedLanes<T>&, RowVector<T>&, const std::vector<std::size_t>&, int, int,              \
                              void (*)(const Slot<T>&), const std::vector<std::size_t>&);
BOUGH_INSTANTIATE(float)
BOUGH_INSTANTIATE(double)
#undef BOUGH_INSTANTIATE

} // namespace bough::fast
