#include "clear_lanes.h"
#include "analytic_rows.h"
#include "lane_tables.h"
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

template <class T> void clear_lanes(Plan<T>& plan, State<T>& state, const std::vector<std::size_t>& bodies) {
    assert(!plan.lanes.sharing.on); // never with /fracture
    const bool analytic = plan.solver == Solver::analytic;
    const int constants = analytic ? analytic::constants(plan.wind) : int(constant::count);
    const int motions = analytic ? int(analytic::motion::count) : int(motion::count);
    RowVector<T>& rows = analytic ? state.lanes.now : state.lanes.table;
    const std::vector<std::size_t> motion_at = motion_of_rows(plan, state);
    constexpr std::size_t lanes = Row<T>::lanes;
    for (const std::size_t body : bodies) {
        const std::size_t slot = plan.lanes.layout.slot[body];
        const Slot<T> row(plan.lanes.constants, constants, slot);
        for (int k = 0; k < constants; ++k) row.put(k, T(0));
        if (analytic)
            put_analytic_pad(row);
        else
            put_pad(row);
        for (int k = 0; k < motions; ++k) rows[motion_at[slot / lanes] + std::size_t(k)].lane[slot % lanes] = 0;
    }
}

template <class T> void put_carried_moment(Plan<T>& plan, std::size_t body) {
    assert(!plan.lanes.sharing.on);
    const Slot<T> row(plan.lanes.constants, constant::count, plan.lanes.layout.slot[body]);
    row.put(constant::carried_moment, plan.carried_moment[body]);
}

template void put_pad(const Slot<float>&);
template void put_pad(const Slot<double>&);
template void put_analytic_pad(const Slot<float>&);
template void put_analytic_pad(const Slot<double>&);
template void clear_lanes(Plan<float>&, State<float>&, const std::vector<std::size_t>&);
template void clear_lanes(Plan<double>&, State<double>&, const std::vector<std::size_t>&);
template void put_carried_moment(Plan<float>&, std::size_t);
template void put_carried_moment(Plan<double>&, std::size_t);

} // namespace bough::fast
